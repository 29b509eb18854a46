#include "drivers/labjack/count_guard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/labjack/counter.h"

namespace mdof::drivers::labjack {
namespace {

constexpr double kMost = 30'000;

// The encoder counts at `counts_per_s` from the time `from_s` on. Returns the time after `from_s`
// at which the guard reports lost counts; INFINITY if it reports nothing within 2 s.
double reported_s(double counts_per_s, double scans_hz, double from_s = 0.5) {
  CountGuard guard(kMost);
  for (int scan = 0; scan < 2 * scans_hz; ++scan) {
    const double t_s = scan / scans_hz;
    const double at = counts_per_s * std::max(0.0, t_s - from_s);
    if (!guard.take(std::llround(at), t_s)) return t_s - from_s;
  }
  return INFINITY;
}

TEST(LabjackCountGuard, ReportsTooHighRatesWithin20Milliseconds) {
  for (const double scans_hz : {50.0, 100.0, 1000.0, 4000.0, 7142.0}) {
    for (const double way : {1.0, -1.0}) {
      EXPECT_EQ(reported_s(way * kMost * 0.99, scans_hz), INFINITY) << scans_hz;
      EXPECT_LE(reported_s(way * kMost * 1.1, scans_hz), 0.0201 + 1 / scans_hz) << scans_hz;
    }
  }
}

// The count jumps by 400 and then stays constant. Such a jump means lost counts. The guard must
// report the loss from this reading on.
TEST(LabjackCountGuard, JumpIsReportedImmediatelyAndPermanently) {
  CountGuard guard(kMost);
  EXPECT_TRUE(guard.take(0, 0));
  EXPECT_FALSE(guard.take(400, 1e-3));
  EXPECT_FALSE(guard.take(400, 10));
  guard.interrupt();
  EXPECT_FALSE(guard.take(400, 0));
}

TEST(LabjackCountGuard, IgnoresMotionBetweenStreams) {
  CountGuard guard(kMost);
  EXPECT_TRUE(guard.take(0, 5));
  guard.interrupt();
  EXPECT_TRUE(guard.take(1'000'000, 0));
  EXPECT_TRUE(guard.take(1'000'010, 1e-3));
}

TEST(LabjackCountGuard, ChecksNothingWithoutALimit) {
  CountGuard guard;
  EXPECT_TRUE(guard.take(0, 0));
  EXPECT_TRUE(guard.take(1'000'000'000, 1e-3));
}

TEST(LabjackCountGuard, GivesTheSpeedForTheResolution) {
  EXPECT_EQ(speed_text(30'000, -0.05), "counts up to 1.5 mm/s");
  EXPECT_EQ(speed_text(70'000, 1), "counts up to 70 mm/s");
  EXPECT_EQ(speed_text(0, 0.05), "");
}

// The guard tolerates two counts more than the rate allows, because an oscillating edge is not a
// loss. restart() clears an earlier loss.
TEST(LabjackCountGuard, AllowsOscillatingEdgesAndRestarts) {
  CountGuard guard(10);
  EXPECT_TRUE(guard.take(0, 0));
  EXPECT_TRUE(guard.take(2, 0.001));
  EXPECT_FALSE(guard.take(3, 0.002));
  EXPECT_FALSE(guard.sure());
  guard.restart();
  EXPECT_TRUE(guard.sure());
  EXPECT_TRUE(guard.take(1000, 0.003));
}

// If the device has kept its power, the count continues past 0x7FFFFFFF as a positive number. After
// a restart of the device, the same 32 bits are a negative count.
TEST(LabjackCounter, RestartedDeviceCountsFromItsOwnZero) {
  Counter counter;
  counter.resume_count(false);
  (void)counter.take(0x7FFF'FFFF, 0);
  EXPECT_EQ(counter.take(0x8000'0010, 0.1), 0x8000'0010LL);
  counter.resume_count(true);
  EXPECT_EQ(counter.take(0x8000'0011, 0.2), 0x8000'0011LL);
  counter.resume_count(false);
  EXPECT_EQ(counter.take(0x8000'0010, 0.3), 0x8000'0010LL - 0x1'0000'0000LL);
  EXPECT_FALSE(counter.sure());
}

}  // namespace
}  // namespace mdof::drivers::labjack
