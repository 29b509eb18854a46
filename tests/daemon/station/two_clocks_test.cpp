// Probe and encoder on two devices. Their clocks differ by 100 ppm, and their packets have 3 ms of
// jitter. The axis moves at 20 mm/s over a slope of 50 µm/m. The remaining error of time changes a
// reading by less than 5 nm.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/points/align.h"
#include "drivers/clock/device_clock.h"
#include "schema/base/random.h"

namespace mdof {
namespace {

constexpr double kSpeed_m_s = 0.020, kSlope = 50e-6, kBound_m = 5e-9;
constexpr double kJitter_ns = 3e6;
constexpr std::int64_t kPacket = 8;

// A device that samples at `rate_hz` of its own clock. Its packets arrive late.
class Device {
 public:
  enum class Times { fitted, nominal };
  Device(std::string channel, double rate_hz, double ppm, std::uint32_t seed, Times times)
      : channel_(std::move(channel)),
        tick_ns_(1e9 / rate_hz),
        ppm_(ppm),
        seed_(seed),
        times_(times),
        clock_(tick_ns_) {}

  double true_s(std::int64_t tick) const {
    return static_cast<double>(tick) * tick_ns_ * 1e-9 / (1 + ppm_ * 1e-6);
  }
  double received_s() const {
    const Philox r = philox({static_cast<std::uint32_t>(next_), 0, 0, seed_}, 5);
    return true_s(next_ + kPacket - 1) + 1e-9 * kJitter_ns * uniform(r[0], r[1]);
  }
  // Returns the next packet. Each sample is `value` at its true time; its time stamp is calculated
  // by the clock model.
  template <class Value>
  SampleBlock packet(Value value) {
    clock_.add(next_ + kPacket - 1 + jump_, std::llround(received_s() * 1e9));
    SampleBlock block;
    block.device = channel_;
    block.channels = {{channel_, Unit::metre}};
    block.value.resize(1);
    for (const std::int64_t end = next_ + kPacket; next_ < end; ++next_) {
      block.time_ns.push_back(times_ == Times::fitted
                                  ? clock_.host_ns(next_ + jump_)
                                  : std::llround(static_cast<double>(next_) * tick_ns_));
      block.value[0].push_back(value(true_s(next_)));
    }
    if (clock_.doubtful())  // as daemon/acquisition does
      block.quality.assign(1, std::vector<Quality>(block.scans(), Quality::suspect));
    return block;
  }
  // From now on, the device counts ticks that it does not sample.
  void jump(double by_s) { jump_ = std::llround(by_s * 1e9 / tick_ns_); }

 private:
  std::string channel_;
  double tick_ns_, ppm_;
  std::uint32_t seed_;
  Times times_;
  drivers::DeviceClock clock_;
  std::int64_t next_ = 0, jump_ = 0;
};

// The largest error of a usable reading in 100 s; m. After 50 s the clock of the probe jumps
// forward.
double worst_m(Device::Times times, double jump_s = 0) {
  const auto travel_m = [](double t_s) { return kSpeed_m_s * t_s; };
  Device encoder(kEncoderChannel, 4000, -50, 1, times), probe("A", 3900, 50, 2, times);
  algo::Aligner aligner({}, {"A"});
  FrameBlock frames;
  double worst = 0;
  std::size_t compared = 0;
  while (encoder.received_s() < 100) {
    if (probe.received_s() > 50) probe.jump(jump_s);
    Device& next = encoder.received_s() < probe.received_s() ? encoder : probe;
    SampleBlock block = &next == &encoder
                            ? next.packet(travel_m)
                            : next.packet([&](double t_s) { return kSlope * travel_m(t_s); });
    EXPECT_TRUE(aligner.push(block, frames));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!usable(frames.quality_at(0, i))) continue;
      ++compared;
      worst = std::max(worst, std::abs(frames.probe_m[0][i] - kSlope * frames.encoder_m[i]));
    }
    frames = {};
  }
  EXPECT_GT(compared, jump_s > 0 ? 370'000u : 390'000u);  // a jump is flagged for 4 s
  return worst;
}

TEST(TwoClocks, AProbeIsAlignedToTheEncodersTimeWithin5nm) {
  const double worst = worst_m(Device::Times::fitted);
  EXPECT_LT(worst, kBound_m);
  EXPECT_GT(worst, 0.0);
  RecordProperty("worst_nm", std::to_string(worst * 1e9));
}

// A jump of 60 ms changes the readings by 60 nm. No usable reading contains it.
TEST(TwoClocks, AJumpOfAClockChangesNoUsableReading) {
  EXPECT_LT(worst_m(Device::Times::fitted, 0.06), kBound_m);
}

// Control: if the nominal rates of the devices are used as true rates, the error exceeds the
// limit.
TEST(TwoClocks, NominalRatesAreNotSufficient) {
  EXPECT_GT(worst_m(Device::Times::nominal), kBound_m);
}

}  // namespace
}  // namespace mdof
