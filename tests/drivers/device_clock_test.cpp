// Compares the times that the device clock calculates with the true times of a simulated device.
#include "drivers/clock/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/base/random.h"

namespace mdof::drivers {
namespace {

constexpr double kTick_ns = 250'000;  // sampling at 4 kHz
constexpr std::int64_t kPacket = 8;

// A device that sends packets of kPacket samples. The delay of a packet is 0.1 ms plus a random
// part from 0 to jitter_ns. On average one of 500 packets is 80 ms later.
struct Device {
  double ppm, jitter_ns;
  std::int64_t start_ns = 5'000'000'000;

  double true_ns(std::int64_t tick) const {
    return static_cast<double>(start_ns) + static_cast<double>(tick) * kTick_ns / (1 + ppm * 1e-6);
  }
  std::int64_t received_ns(std::int64_t packet) const {
    const Philox r = philox({static_cast<std::uint32_t>(packet), 0, 0, 0}, 11);
    const double late_ns = r[2] % 500 == 0 ? 80e6 : 0;
    return std::llround(true_ns(packet * kPacket + kPacket - 1) + 0.1e6 +
                        jitter_ns * uniform(r[0], r[1]) + late_ns);
  }
};

// Largest errors of the calculated times in µs. early_us: for times before settled_ns, late_us:
// after it.
struct Worst {
  double early_us = 0, late_us = 0;
  bool monotonic = true;
};
Worst follow(DeviceClock& clock, const Device& device, std::int64_t packets,
             double settled_ns = 6e9) {
  Worst worst;
  std::int64_t last = INT64_MIN;
  for (std::int64_t p = 0; p < packets; ++p) {
    clock.add(p * kPacket + kPacket - 1, device.received_ns(p));
    for (std::int64_t t = p * kPacket; t < (p + 1) * kPacket; ++t) {
      const std::int64_t ns = clock.host_ns(t);
      worst.monotonic = worst.monotonic && ns > last;
      last = ns;
      double& w = static_cast<double>(t) * kTick_ns < settled_ns ? worst.early_us : worst.late_us;
      w = std::max(w, std::abs(static_cast<double>(ns) - device.true_ns(t)) / 1e3);
    }
  }
  return worst;
}

TEST(DeviceClock, FollowsADriftThroughJitter) {
  for (const double ppm : {100.0, -100.0, 0.0, 500.0}) {
    DeviceClock clock(kTick_ns);
    const Worst worst = follow(clock, {ppm, 3e6}, 30'000);  // one minute
    EXPECT_TRUE(worst.monotonic);
    EXPECT_LT(worst.early_us, 3'100) << ppm;
    EXPECT_LT(worst.late_us, 500) << ppm;
    EXPECT_NEAR(clock.state().drift_ppm, ppm, 3) << ppm;
    EXPECT_TRUE(clock.state().settled);
    EXPECT_EQ(clock.state().steps, 0u);
    EXPECT_NEAR(static_cast<double>(clock.state().jitter_ns), 3e6, 0.3e6);
  }
}

// The computer is busy when a device is opened, so the first packets seem to arrive 60 ms late.
TEST(DeviceClock, CorrectsLateFirstPacketsWithin600Milliseconds) {
  const Device device{50, 1e6};
  DeviceClock clock(kTick_ns);
  double worst_us = 0;
  for (std::int64_t p = 0; p < 500; ++p) {
    const std::int64_t newest = p * kPacket + kPacket - 1;
    const std::int64_t busy_ns = p < 60 ? 60'000'000 : 0;  // the packets of 0.12 s
    clock.add(newest, device.received_ns(p) + busy_ns);
    const double off_us =
        std::abs(static_cast<double>(clock.host_ns(newest)) - device.true_ns(newest)) / 1e3;
    worst_us = p > 300 ? std::max(worst_us, off_us) : 0;  // checked from 0.6 s on
  }
  EXPECT_LT(worst_us, 1'200);
}

TEST(DeviceClock, IsExactWithoutJitter) {
  DeviceClock clock(kTick_ns);
  for (std::int64_t p = 0; p < 5'000; ++p) {
    const Device device{200, 0};
    clock.add(p * kPacket, std::llround(device.true_ns(p * kPacket)));
    const double error_ns =
        static_cast<double>(clock.host_ns(p * kPacket)) - device.true_ns(p * kPacket);
    ASSERT_LT(std::abs(error_ns), p * kPacket * kTick_ns < 6e9 ? 1.2e6 : 1e3) << p;
  }
}

// A restart of the device sets its count to 0 or to another number.
TEST(DeviceClock, JumpOfTheCountIsAStepAndTimesStillIncrease) {
  for (const std::int64_t jump : {10'000, -10'000}) {
    DeviceClock clock(kTick_ns);
    const Device device{50, 1e6};
    follow(clock, device, 5'000);
    const std::int64_t before = clock.host_ns(5'000 * kPacket);
    std::int64_t last = before, sure = 0;
    for (std::int64_t p = 5'001; p < 8'000; ++p) {
      clock.add(p * kPacket + jump, device.received_ns(p));
      const std::int64_t ns = clock.host_ns(p * kPacket + jump);
      ASSERT_GT(ns, last);
      last = ns;
      sure += !clock.state().doubtful;
    }
    EXPECT_EQ(clock.state().steps, 1u) << jump;
    EXPECT_NEAR(static_cast<double>(last), device.true_ns(7'999 * kPacket), 3e6) << jump;
    EXPECT_NEAR(static_cast<double>(sure), 1'000, 130) << "of 3,000 packets, after 4 s = 2,000";
  }
}

// A link is slow for a while, but loses no packets. During this time the clock is uncertain. Its
// times remain correct, and it reports no step.
TEST(DeviceClock, ASlowLinkIsNoStep) {
  const struct {
    std::int64_t late_ns, packets;  // a packet covers 2 ms
  } cases[] = {{300'000'000, 1'500}, {1'200'000'000, 5'000}, {500'000'000, 20'000}};
  for (const auto& c : cases) {
    // The link becomes slow before or after the clock has settled.
    for (const std::int64_t from : {500, 4'000, 15'000}) {
      DeviceClock clock(kTick_ns);
      const Device device{50, 1e6};
      double worst_us = 0;
      std::int64_t doubtful = 0;
      for (std::int64_t p = 0; p < from + c.packets + 5'000; ++p) {
        const bool late = from <= p && p < from + c.packets;
        const std::int64_t tick = p * kPacket + kPacket - 1;
        clock.add(tick, device.received_ns(p) + (late ? c.late_ns : 0));
        const double off = static_cast<double>(clock.host_ns(tick)) - device.true_ns(tick);
        worst_us = std::max(worst_us, std::abs(off) / 1e3);
        EXPECT_EQ(clock.state().doubtful, late) << p;
        doubtful += clock.state().doubtful;
      }
      // For up to 40 s no new line is fitted; the drift of 50 ppm then makes an error of 2 ms.
      EXPECT_LT(worst_us, 4'500) << c.late_ns;
      EXPECT_EQ(clock.state().steps, 0u);
      EXPECT_EQ(doubtful, c.packets);
    }
  }
}

// The time of the device stops for 0.3 s. The clock is uncertain from the first later packet on,
// until it has fitted a new line. A new line takes 64 s.
TEST(DeviceClock, UncertainAfterDeviceTimeStoppedUntilSettled) {
  DeviceClock clock(kTick_ns);
  const Device device{0, 1e6};
  const std::int64_t from = 4'000, end = from + 35'000;
  double worst_sure_us = 0;
  bool sure_again = false;
  for (std::int64_t p = 0; p < end; ++p) {
    const std::int64_t tick = p * kPacket + kPacket - 1, still_ns = p >= from ? 300'000'000 : 0;
    clock.add(tick, device.received_ns(p) + still_ns);
    const std::int64_t ns = clock.host_ns(tick);
    if (clock.state().doubtful) continue;
    EXPECT_TRUE(p < from || p > from + 31'800) << p;
    sure_again = sure_again || p >= from;
    const double true_ns = device.true_ns(tick) + static_cast<double>(still_ns);
    worst_sure_us = std::max(worst_sure_us, std::abs(static_cast<double>(ns) - true_ns) / 1e3);
  }
  EXPECT_EQ(clock.state().steps, 1u);
  EXPECT_TRUE(sure_again);
  EXPECT_LT(worst_sure_us, 1'200);
}

TEST(DeviceClock, SameCallsGiveTheSameBits) {
  DeviceClock a(kTick_ns), b(kTick_ns);
  const Device device{77, 2e6};
  for (std::int64_t p = 0; p < 4'000; ++p) {
    a.add(p * kPacket, device.received_ns(p));
    b.add(p * kPacket, device.received_ns(p));
    ASSERT_EQ(a.host_ns(p * kPacket), b.host_ns(p * kPacket));
  }
}

TEST(DeviceClock, TimesStillIncreaseAfterAReset) {
  DeviceClock clock(kTick_ns);
  follow(clock, {0, 1e6}, 1'000);
  const std::int64_t last = clock.host_ns(8'000);
  clock.reset();
  clock.add(0, last - 5'000'000);  // the device was opened again immediately
  EXPECT_GT(clock.host_ns(0), last);
}

}  // namespace
}  // namespace mdof::drivers
