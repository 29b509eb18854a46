// Tests the rule of resolution.h with values calculated by hand: which steps are the resolution.
#include "algo/plausibility/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mdof::algo {
namespace {

// Resolution of readings with these steps; each reading is repeated once.
double step_of(const std::vector<double>& steps) {
  std::vector<double> readings = {0, 0};
  for (const double step : steps) {
    const double next = readings.back() + step;
    readings.insert(readings.end(), {next, next});
  }
  Resolution resolution;
  resolution.add(readings);
  return resolution.step();
}

std::vector<double> repeated(double step, std::size_t n, std::vector<double> others = {}) {
  others.insert(others.end(), n, step);
  return others;
}

TEST(Resolution, IsAStepThatOccursThreeTimes) {
  EXPECT_EQ(step_of({1, 1}), 0);
  EXPECT_EQ(step_of({1, 1, 1}), 1);
  EXPECT_EQ(step_of({1, -1, 1}), 1);
  EXPECT_EQ(step_of({1, 2, 4}), 0);
  EXPECT_EQ(step_of({1, 1, 2}), 0);
  EXPECT_NEAR(step_of({1.04, 1, 1.02}), 1, 1e-12);  // printed with few digits
  EXPECT_EQ(step_of({1, 1.02, 1.06}), 0);
}

// If there are few steps, three quarters of them must be equal. If there are sixteen or more, an
// eighth of them must be equal.
TEST(Resolution, NeedsMostOfFewSteps) {
  EXPECT_EQ(step_of(repeated(1, 6, {2, 4})), 1);
  EXPECT_EQ(step_of(repeated(1, 5, {2, 4, 8})), 0);
  EXPECT_EQ(step_of(repeated(4, 6, {1, 2})), 4);  // a single smaller step is ignored
  EXPECT_EQ(step_of(repeated(1, 3, {2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096})), 0);
  EXPECT_EQ(step_of(repeated(1, 3, {2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192})),
            1);
}

// The rule uses only the 64 smallest of many steps; eight of them must be equal.
TEST(Resolution, IsTheSmallestRepeatedStepOfMany) {
  std::vector<double> steps;
  for (int i = 0; i < 200; ++i) steps.push_back(i % 20 == 0 ? 1 : i % 5 == 1 ? 3 : 100);
  EXPECT_EQ(step_of(steps), 1);
  for (int i = 0; i < 200; ++i) steps[static_cast<std::size_t>(i)] = i % 40 == 0 ? 1 : 3;
  EXPECT_EQ(step_of(steps), 3);
}

TEST(Resolution, NeedsRepeatedReadings) {
  Resolution none;
  none.add(std::vector<double>{0, 0, 1, 2, 2, 3, 3.5, 3.5,
                               4});  // no step has repeated readings on both sides
  none.add(std::vector<double>{0, 1, 1, 2, 2, 3, 3, 4, 4});  // begins without a repeated reading
  none.add(std::vector<double>{0, 0, 1});                    // too few steps
  none.add(std::vector<double>{0, 0, INFINITY, INFINITY, 0, 0, INFINITY, INFINITY, 0, 0});
  EXPECT_EQ(none.step(), 0);
  Resolution parts;  // the same readings in several blocks
  for (int i = 0; i < 3; ++i) parts.add(std::vector<double>{0, 0, 2, 2});
  EXPECT_EQ(parts.step(), 2);
}

// If the noise is at least half a step, the rounding errors average out. If it is smaller, the
// rounding error has a rectangular distribution.
TEST(Resolution, IsInTheUncertaintyUnlessNoiseAveragesIt) {
  EXPECT_EQ(with_resolution(3, 1.0, 2), 3);
  EXPECT_NEAR(with_resolution(3, 0.99, 2), std::sqrt(9 + 4 / 12.0), 1e-12);
  EXPECT_NEAR(with_resolution(0, 0, 6), 6 / std::sqrt(12), 1e-12);
}

// Readings that repeat many times have no steps of 0.
TEST(Resolution, ReadingsMayRepeatManyTimes) {
  std::vector<double> readings;
  for (const double x : {0.5, 2.5, 0.5, 2.5}) readings.insert(readings.end(), 40, x);
  Resolution resolution;
  resolution.add(readings);
  EXPECT_EQ(resolution.step(), 2);
}

// The equal steps of 1 are from a repeated reading to a single one, or from a single one to a
// repeated one. The other steps differ.
TEST(Resolution, NeedsRepeatedReadingsOnBothSides) {
  Resolution left, right;
  left.add(std::vector<double>{0, 0, 1, 3, 3, 4, 8, 8, 9, 17, 17, 18, 34, 34, 35, 67, 67});
  EXPECT_EQ(left.step(), 0);
  right.add(std::vector<double>{0, 0, 2, 3, 3, 7, 8, 8, 16, 17, 17, 33, 34, 34, 66, 67, 67});
  EXPECT_EQ(right.step(), 0);
}

// The other steps grow by 6 % each, so no two are equal. Eight of 64 steps must be equal. A larger
// step that is added changes nothing.
TEST(Resolution, NeedsEightOfSixtyFourSteps) {
  const auto steps_with_outliers = [](std::size_t strays, std::size_t equal) {
    std::vector<double> steps;
    for (std::size_t i = 0; i < strays; ++i) steps.push_back(std::pow(1.06, i));
    return repeated(128, equal, steps);
  };
  EXPECT_NEAR(step_of(steps_with_outliers(56, 8)), 128, 1e-9);
  EXPECT_EQ(step_of(steps_with_outliers(57, 7)), 0);
  std::vector<double> later = steps_with_outliers(56, 8);
  later.push_back(1024);
  EXPECT_NEAR(step_of(later), 128, 1e-9);
}

// Only rows 2 to 9 are used. Probe B repeats its reading in the fifth of these rows; from this row
// on, its resolution is unknown.
TEST(ProbeResolution, IsUnknownForAProbeSlowerThanTheEncoder) {
  FrameBlock frames;
  frames.probe_m = {{0, 1, 0, 0, 2, 2, 0, 0, 2, 2, 7}, {0, 1, 0, 0, 3, 3, 0, 0, 3, 3, 7}};
  frames.probe_is_new = {std::vector<std::uint8_t>(11, 1), {1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 0}};
  ProbeResolution resolution(2);
  resolution.add(frames, 2, 10);
  EXPECT_EQ(resolution.step_m(0), 2);
  EXPECT_EQ(resolution.step_m(1), 3);
  ProbeResolution slow(2);
  frames.probe_is_new[1][6] = 0;
  slow.add(frames, 2, 10);
  EXPECT_EQ(slow.step_m(0), 2);
  EXPECT_EQ(slow.step_m(1), 0);
  frames.probe_is_new.clear();
  slow.add(frames, 2, 10);
  EXPECT_EQ(slow.step_m(1), 0);
}

}  // namespace
}  // namespace mdof::algo
