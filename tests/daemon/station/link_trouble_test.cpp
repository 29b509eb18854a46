// Faulty links during a run, in virtual time. Two devices like the capaNCDT measure the probes,
// and a device like the T7 counts the encoder. Each device has its own clock and packets of 4 ms.
// In each scenario one link has one of these faults:
// - it is slow, or becomes slow
// - it stalls and then delivers everything at once
// - it loses or damages packets
// - the time of the device stops
// A point is wrong if its readings do not belong to its position. Each wrong point must have a
// flag. MDOF_LINK_SCENARIOS=200 runs the full campaign.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "daemon/measure/pipeline.h"
#include "drivers/clock/device_clock.h"
#include "schema/base/random.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {
namespace {

constexpr double kTick_s = 1e-3, kWrong_m = 20e-9;
constexpr std::int64_t kPacket = 4;                            // ticks in one packet
constexpr double kDwell_s = 0.5, kMove_s = 0.1, kStep_mm = 1;  // the axis moves at 10 mm/s
constexpr int kLinkTargets = 8, kPasses = 8;                   // four runs in both directions
constexpr double kEnd_s = (kLinkTargets + 1) * kPasses * (kDwell_s + kMove_s);
// Slopes of the probes A to E in µm per mm of travel. Between two targets each reading changes by
// at least 1 µm.
constexpr std::array<double, 5> kSlope = {1.0, -1.3, 1.7, 2.1, -1.1};

// Travel at time t_s. A pass begins at the reversal position of -1 mm, goes over the targets and
// reverses beyond the last target; the next pass goes back.
double travel_mm(double t_s) {
  const double step_s = kDwell_s + kMove_s;
  const auto place = [](std::int64_t stop) {
    const std::int64_t in_pass = stop % (kLinkTargets + 1);
    const bool forward = stop / (kLinkTargets + 1) % 2 == 0;
    return kStep_mm * static_cast<double>(forward ? in_pass - 1 : kLinkTargets - in_pass);
  };
  const auto stop = static_cast<std::int64_t>(std::max(t_s, 0.0) / step_s);
  const double since_s = t_s - static_cast<double>(stop) * step_s;
  if (since_s < kDwell_s) return place(stop);
  return place(stop) + (place(stop + 1) - place(stop)) * (since_s - kDwell_s) / kMove_s;
}

enum class Kind { slow, growing, stalled, lost, garbled, stood_still };
constexpr int kKinds = 6;

struct LinkFault {
  Kind kind = Kind::slow;
  int device = 0;
  double begin_s = 0, length_s = 0, late_s = 0;

  bool at(double t_s) const { return begin_s <= t_s && t_s < begin_s + length_s; }
};

LinkFault trouble_of(std::uint32_t scenario) {
  const Philox a = philox({scenario, 0, 0, 0}, 77), b = philox({scenario, 1, 0, 0}, 77);
  LinkFault t;
  t.kind = static_cast<Kind>(scenario % kKinds);
  t.device = static_cast<int>(scenario / kKinds % 3);
  t.begin_s = 2 + 28 * uniform(a[0], a[1]);
  t.length_s = 0.3 + 11.7 * uniform(a[2], a[3]);
  t.late_s = 0.03 + 1.3 * uniform(b[0], b[1]);
  return t;
}

// A device that samples with its own clock and sends packets over its own link.
class Device {
 public:
  Device(std::string name, std::vector<Channel> channels, double ppm, std::uint32_t seed)
      : name_(std::move(name)), channels_(std::move(channels)), ppm_(ppm), seed_(seed) {}

  double true_s(std::int64_t tick) const {
    return static_cast<double>(tick) * kTick_s / (1 + 1e-6 * ppm_) + stood_s_;
  }

  // Time at which the next packet arrives. A packet never arrives before an earlier packet.
  double received_s(const LinkFault* trouble) const {
    const Philox r = philox({static_cast<std::uint32_t>(next_), 0, 0, seed_}, 5);
    const double sent_s = true_s(next_ + kPacket - 1);
    double delay_s = 2e-4 + 1e-3 * uniform(r[0], r[1]);
    if (trouble && trouble->at(sent_s)) {
      const double share = (sent_s - trouble->begin_s) / trouble->length_s;
      if (trouble->kind == Kind::slow) delay_s += trouble->late_s;
      if (trouble->kind == Kind::growing) delay_s += share * trouble->late_s;
      if (trouble->kind == Kind::stalled) delay_s += (1 - share) * std::min(trouble->length_s, 2.5);
    }
    return std::max(last_received_s_, sent_s + delay_s);
  }

  // Returns the next packet; the block is empty if the packet was lost.
  SampleBlock take(const LinkFault* trouble, bool marks) {
    const double received = last_received_s_ = received_s(trouble);
    if (trouble && trouble->kind == Kind::stood_still && !stood_ && trouble->at(true_s(next_))) {
      stood_ = true;
      stood_s_ = trouble->late_s;
    }
    const std::int64_t first = next_;
    next_ += kPacket;
    if (is_dropped(trouble, first)) {
      lost_ += static_cast<std::uint64_t>(kPacket);
      return {};
    }
    return block_of(first, received, marks);
  }

 private:
  bool is_dropped(const LinkFault* trouble, std::int64_t first) const {
    if (!trouble || !trouble->at(true_s(first))) return false;
    const Philox r = philox({static_cast<std::uint32_t>(first), 1, 0, seed_}, 5);
    return trouble->kind == Kind::lost || (trouble->kind == Kind::garbled && r[0] % 4 == 0);
  }

  SampleBlock block_of(std::int64_t first, double received_s, bool marks) {
    clock_.add(first + kPacket - 1, std::llround(received_s * 1e9));
    SampleBlock block;
    block.device = name_;
    block.channels = channels_;
    block.value.resize(channels_.size());
    block.lost = std::exchange(lost_, 0);
    for (std::int64_t tick = first; tick < first + kPacket; ++tick) {
      block.time_ns.push_back(clock_.host_ns(tick));
      const double at_mm = travel_mm(true_s(tick));
      for (std::size_t c = 0; c < channels_.size(); ++c)
        block.value[c].push_back(reading(channels_[c].id, at_mm));
    }
    if (marks && clock_.state().doubtful)  // as daemon/acquisition does
      block.quality.assign(channels_.size(), std::vector<Quality>(block.scans(), Quality::suspect));
    return block;
  }

  static double reading(const std::string& channel, double at_mm) {
    return channel == kEncoderChannel ? at_mm
                                      : kSlope[static_cast<std::size_t>(channel[0] - 'A')] * at_mm;
  }

  std::string name_;
  std::vector<Channel> channels_;
  double ppm_;
  std::uint32_t seed_;
  drivers::DeviceClock clock_{kTick_s * 1e9};
  std::int64_t next_ = 0;
  std::uint64_t lost_ = 0;
  double last_received_s_ = 0, stood_s_ = 0;
  bool stood_ = false;
};

struct Outcome {
  int points = 0, unflagged = 0, wrong = 0, wrong_unflagged = 0;
};

bool is_wrong(const Point& point) {
  for (std::size_t c = 0; c < kSlope.size(); ++c) {
    const double expected_m = kSlope[c] * 1e-3 * point.position_m;
    if (std::abs(point.probe_m[c] - expected_m) > kWrong_m)
      return true;  // a reading that is NaN was lost, and its point has a flag
  }
  return false;
}

Outcome measure(const LinkFault& trouble, bool marks) {
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  Pipeline pipeline = Pipeline::create(rig, {}).value();
  std::array<Device, 3> devices = {
      Device("capa-1", {{"A", Unit::um}, {"B", Unit::um}, {"C", Unit::um}}, 40, 1),
      Device("capa-2", {{"D", Unit::um}, {"E", Unit::um}}, -60, 2),
      Device("t7", {{kEncoderChannel, Unit::mm}}, 15, 3)};
  const auto trouble_at = [&](std::size_t d) {
    return static_cast<int>(d) == trouble.device ? &trouble : nullptr;
  };
  for (;;) {
    std::size_t next = 0;
    for (std::size_t d = 1; d < devices.size(); ++d)
      if (devices[d].received_s(trouble_at(d)) < devices[next].received_s(trouble_at(next)))
        next = d;
    if (devices[next].received_s(trouble_at(next)) > kEnd_s) break;
    SampleBlock block = devices[next].take(trouble_at(next), marks);
    if (block.scans() == 0) continue;
    EXPECT_TRUE(pipeline.push(block));
  }
  Outcome outcome;
  const auto run = pipeline.finish();
  if (!run) return outcome;  // the run was rejected with a reason
  for (const MeasuredPoint& p : run->points) {
    const bool flagged = !p.point.flags.empty(), wrong = is_wrong(p.point);
    ++outcome.points;
    outcome.unflagged += !flagged;
    outcome.wrong += wrong;
    outcome.wrong_unflagged += wrong && !flagged;
  }
  return outcome;
}

int scenarios() {
  const char* asked = std::getenv("MDOF_LINK_SCENARIOS");
  return asked ? std::atoi(asked) : 30;
}

std::string described(int scenario, const LinkFault& t) {
  return "scenario " + std::to_string(scenario) + ": kind " +
         std::to_string(static_cast<int>(t.kind)) + ", device " + std::to_string(t.device) + ", " +
         std::to_string(t.late_s) + " s from " + std::to_string(t.begin_s) + " for " +
         std::to_string(t.length_s) + " s";
}

TEST(LinkTrouble, NoPointIsWrongWithoutAFlag) {
  Outcome sum;
  for (int i = 0; i < scenarios(); ++i) {
    const LinkFault trouble = trouble_of(static_cast<std::uint32_t>(i));
    const Outcome one = measure(trouble, true);
    EXPECT_EQ(one.wrong_unflagged, 0) << described(i, trouble);
    sum.points += one.points;
    sum.unflagged += one.unflagged;
    sum.wrong += one.wrong;
  }
  // Most points must have no flag. Otherwise flags on all points would pass the test.
  EXPECT_GT(sum.unflagged, scenarios() * 25);
  RecordProperty("points", sum.points);
  RecordProperty("unflagged", sum.unflagged);
  RecordProperty("wrong_flagged", sum.wrong);
}

// Control: if the quality of the clock is ignored, some points are wrong and have no flag.
TEST(LinkTrouble, WithoutTheClockQualitySomePointsAreWrong) {
  int wrong = 0;
  for (int i = kKinds - 1; i < 30; i += kKinds)  // scenarios in which the time of a device stops
    wrong += measure(trouble_of(static_cast<std::uint32_t>(i)), false).wrong_unflagged;
  EXPECT_GT(wrong, 0);
}

}  // namespace
}  // namespace mdof::daemon
