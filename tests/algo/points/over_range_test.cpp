// The readings of a probe at the end of its range are missing, so the mean of the other readings is
// biased. The expected bias comes from tables of the normal distribution, and from a vibration with
// a known mean.
#include "algo/points/over_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "algo/points/flags.h"
#include "tests/algo/stepping_axis.h"

namespace mdof::algo {
namespace {

constexpr double kEnd_m = 100e-6;

// Three stops with about 150 averaged scans each. The probe vibrates about `middle_m`.
FrameBlock vibrating(double middle_m, double amplitude_m) {
  SteppingAxis axis;
  for (const double target_m : {0.0, 2e-3, 4e-3}) axis.stop(target_m);
  axis.move_to(5e-3);
  auto& reading_m = axis.frames.probe_m[0];
  axis.frames.probe_quality[0].assign(reading_m.size(), Quality::good);
  for (std::size_t i = 0; i < reading_m.size(); ++i) {
    const double t_s = 1e-9 * static_cast<double>(axis.frames.time_ns[i]);
    reading_m[i] = middle_m + amplitude_m * std::sin(2 * std::numbers::pi * 47 * t_s);
    if (reading_m[i] < kEnd_m) continue;
    reading_m[i] = kEnd_m;
    axis.frames.probe_quality[0][i] = Quality::over_range;
  }
  return axis.frames;
}

std::vector<Point> points_of(const FrameBlock& frames) {
  DwellDetector detector({}, {"A"}, {2 * kEnd_m});
  std::vector<Point> found;
  detector.push(frames, found);
  detector.flush(found);
  return found;
}

OverRange one_over_range_reading(double at_m) {
  OverRange over;
  over.add(at_m);
  return over;
}

// A fraction p of the readings, above the end of the range, is missing. The bias of the mean is
// phi(a)/Phi(a) standard deviations with Phi(-a) = p. The values are from a table of the normal
// distribution.
TEST(OverRange, UCoversTheBiasOfOneOverRangeReading) {
  struct {
    std::size_t of;
    double bias;
  } const table[] = {{5, 0.27996 / 0.8},
                     {10, 0.17550 / 0.9},
                     {20, 0.10314 / 0.95},
                     {100, 0.026652 / 0.99},
                     {1000, 0.0033671 / 0.999}};
  for (const auto& [of, bias] : table) {
    const double u_m = u_with_over_range(0, 0, 1e-6, one_over_range_reading(2e-6), of);
    EXPECT_GE(u_m, bias * 1e-6) << of;
    EXPECT_LE(u_m, 2.5 * bias * 1e-6) << of;
  }
  EXPECT_NEAR(u_with_over_range(3e-9, 0, 1e-6, one_over_range_reading(2e-6), 1000), 5e-9, 1e-15);
  EXPECT_EQ(u_with_over_range(3e-9, 0, 1e-6, {}, 1000), 3e-9);
  // A reading far away is a glitch.
  EXPECT_EQ(u_with_over_range(3e-9, 0, 1e-6, one_over_range_reading(-50e-6), 1000), 3e-9);
}

bool saturates_channel(std::size_t count, std::size_t readings, double at_m = 1e-6) {
  OverRange over;
  for (std::size_t i = 0; i < count; ++i) over.add(at_m);
  return is_saturated(over, readings, 0, 0.5e-6);
}

TEST(OverRange, SaturatedAboveOneReadingAndOnePercent) {
  EXPECT_FALSE(saturates_channel(0, 0));
  EXPECT_FALSE(saturates_channel(1, 10));
  EXPECT_TRUE(saturates_channel(2, 10));
  EXPECT_FALSE(saturates_channel(2, 200));
  EXPECT_TRUE(saturates_channel(3, 299));
  EXPECT_FALSE(saturates_channel(3, 300));
}

// An over-range reading far above or below the mean is a glitch, for example from a broken cable.
TEST(OverRange, GlitchDoesNotSaturate) {
  for (const double at_m : {100e-6, -100e-6}) EXPECT_FALSE(saturates_channel(20, 100, at_m));
  EXPECT_TRUE(saturates_channel(20, 100, -2.9e-6));
  EXPECT_TRUE(saturates_channel(20, 100, std::nan("")));
}

// The vibration has an rms of 0.7 um about 99.9 um. The mean of the readings below 100 um is 99.3
// um.
TEST(OverRange, VibrationAcrossTheEndLosesTheProbe) {
  const auto points = points_of(vibrating(99.9e-6, 0.7e-6 * std::numbers::sqrt2));
  ASSERT_EQ(points.size(), 3u);
  for (const Point& point : points) {
    EXPECT_TRUE(std::isnan(point.probe_m[0])) << point.probe_m[0];
    EXPECT_TRUE(has_flag(point, Flag::lost, "A"));
    EXPECT_TRUE(has_flag(point, Flag::saturated, "A"));
  }
}

TEST(OverRange, VibrationBelowTheEndIsAveraged) {
  const auto points = points_of(vibrating(98.9e-6, 0.7e-6 * std::numbers::sqrt2));
  ASSERT_EQ(points.size(), 3u);
  for (const Point& point : points) {
    EXPECT_NEAR(point.probe_m[0], 98.9e-6, 3 * point.probe_u_m[0]);
    EXPECT_TRUE(point.flags.empty()) << to_string(point.flags);
  }
}

}  // namespace
}  // namespace mdof::algo
