// A run of 10,000 points.
// - The CPU time for a point does not increase with the number of earlier points.
// - The end of the run needs less CPU time than the measurement.
// - The result equals the result of a pipeline that is read only at the end.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "daemon/measure/pipeline.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {
namespace {

// kStopScans, kMoveScans: numbers of scans, at 100 Hz.
constexpr int kTargets = 6, kPoints = 10'000, kStopScans = 40, kMoveScans = 8;

// An axis that moves over the six targets and back, and reverses 1 mm beyond both ends. Each call
// returns the scans of one stop and of the movement to it.
class LongAxis {
 public:
  SampleBlock next_stop() {
    block_ = {};
    block_.device = "daq";
    block_.channels = {{kEncoderChannel, Unit::mm}};
    for (const char* id : {"A", "B", "C", "D", "E"}) block_.channels.push_back({id, Unit::um});
    block_.value.resize(6);
    const int in_pass = stop_ % kTargets;
    const bool forward = stop_ / kTargets % 2 == 0;
    if (in_pass == 0) move_to(forward ? -1 : kTargets);
    move_to(forward ? in_pass : kTargets - 1 - in_pass);
    for (int i = 0; i < kStopScans; ++i) scan();
    ++stop_;
    return std::move(block_);
  }

 private:
  void move_to(double to_mm) {
    const double from_mm = at_mm_;
    for (int i = 1; i <= kMoveScans; ++i) {
      at_mm_ = from_mm + (to_mm - from_mm) * i / kMoveScans;
      scan();
    }
  }
  void scan() {
    block_.time_ns.push_back(++scans_ * 10'000'000);
    block_.value[0].push_back(at_mm_);
    for (std::size_t c = 1; c < 6; ++c)
      block_.value[c].push_back(static_cast<double>(c) + 0.1 * at_mm_ +
                                0.01 * static_cast<double>(scans_ * static_cast<int>(c) * 7 % 13));
  }

  SampleBlock block_;
  double at_mm_ = -1;
  int stop_ = 0;
  std::int64_t scans_ = 0;
};

double cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(LongRun, APointNeedsEqualCpuTimeAtTheStartAndTheEnd) {
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  Pipeline asked = Pipeline::create(rig, {}).value(), silent = Pipeline::create(rig, {}).value();
  double early_s = 0, late_s = 0;
  const double begin_s = cpu_s();
  std::size_t points = 0;
  LongAxis axis;
  for (int stop = 0; points < kPoints; ++stop) {
    ASSERT_LT(stop, kPoints + 10) << "stops are missing";
    SampleBlock block = axis.next_stop(), same = block;
    ASSERT_TRUE(silent.push(same));
    ASSERT_TRUE(asked.push(block));
    const double before_s = cpu_s();
    points = asked.points().size();
    const double took_s = cpu_s() - before_s;
    early_s += points >= 1'000 && points < 2'000 ? took_s : 0;
    late_s += points >= 5'000 ? took_s : 0;
  }
  // If the time of a point increased with the number of earlier points, a point would need about
  // five times as long after five times as many points.
  RecordProperty("early_us_a_point", std::to_string(1e3 * early_s));
  RecordProperty("late_us_a_point", std::to_string(1e6 * late_s / 5'000));
  EXPECT_LT(late_s / 5, 2.5 * early_s);
  const double measured_s = cpu_s();
  const auto a = asked.finish();
  // 10,000 points at six targets are 833 passes forward and back, and an incomplete pass.
  // The test for a drift takes about 40 us a point.
  EXPECT_LT(cpu_s() - measured_s, measured_s - begin_s);
  const auto b = silent.finish();
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->points.size(), b->points.size());
  for (std::size_t i = 0; i < a->points.size(); ++i) {
    ASSERT_EQ(a->points[i].target, b->points[i].target) << i;
    ASSERT_EQ(a->points[i].run, b->points[i].run) << i;
    ASSERT_EQ(a->points[i].errors.local, b->points[i].errors.local) << i;
    ASSERT_EQ(a->points[i].point.flags, b->points[i].point.flags) << i;
  }
}

}  // namespace
}  // namespace mdof::daemon
