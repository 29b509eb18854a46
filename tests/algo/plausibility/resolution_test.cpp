// The rule of resolution.h by hand: which steps make a resolution.
#include "algo/plausibility/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mdof::algo {
namespace {

// Each step stands between two readings that stayed.
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

TEST(Resolution, IsAStepSeenThreeTimes) {
  EXPECT_EQ(step_of({1, 1}), 0);
  EXPECT_EQ(step_of({1, 1, 1}), 1);
  EXPECT_EQ(step_of({1, -1, 1}), 1);
  EXPECT_EQ(step_of({1, 2, 4}), 0);
  EXPECT_EQ(step_of({1, 1, 2}), 0);
  EXPECT_NEAR(step_of({1.04, 1, 1.02}), 1, 1e-12);  // printed with few digits
  EXPECT_EQ(step_of({1, 1.02, 1.06}), 0);
}

// Of few steps three quarters agree, of sixteen and more an eighth.
TEST(Resolution, MostStepsOfFewAgree) {
  EXPECT_EQ(step_of(repeated(1, 6, {2, 4})), 1);
  EXPECT_EQ(step_of(repeated(1, 5, {2, 4, 8})), 0);
  EXPECT_EQ(step_of(repeated(4, 6, {1, 2})), 4);  // a stray smaller one is none
  EXPECT_EQ(step_of(repeated(1, 3, {2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096})), 0);
  EXPECT_EQ(step_of(repeated(1, 3, {2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192})),
            1);
}

// Of many only the sixty-four smallest are kept, of which eight agree.
TEST(Resolution, TheSmallestOfManyThatComesAgain) {
  std::vector<double> steps;
  for (int i = 0; i < 200; ++i) steps.push_back(i % 20 == 0 ? 1 : i % 5 == 1 ? 3 : 100);
  EXPECT_EQ(step_of(steps), 1);
  for (int i = 0; i < 200; ++i) steps[static_cast<std::size_t>(i)] = i % 40 == 0 ? 1 : 3;
  EXPECT_EQ(step_of(steps), 3);
}

TEST(Resolution, OnlyBetweenReadingsThatStayed) {
  Resolution none;
  none.add(std::vector<double>{0, 0, 1, 2, 2, 3, 3.5, 3.5, 4});  // never stayed on both sides
  none.add(std::vector<double>{0, 1, 1, 2, 2, 3, 3, 4, 4});      // begins in noise
  none.add(std::vector<double>{0, 0, 1});                        // too few
  none.add(std::vector<double>{0, 0, INFINITY, INFINITY, 0, 0, INFINITY, INFINITY, 0, 0});
  EXPECT_EQ(none.step(), 0);
  Resolution parts;  // the same by parts
  for (int i = 0; i < 3; ++i) parts.add(std::vector<double>{0, 0, 2, 2});
  EXPECT_EQ(parts.step(), 2);
}

// What rounding leaves of noise: half a step or more averages out, less is a rectangle.
TEST(Resolution, IsInTheUncertaintyUnlessNoiseDithers) {
  EXPECT_EQ(with_resolution(3, 1.0, 2), 3);
  EXPECT_NEAR(with_resolution(3, 0.99, 2), std::sqrt(9 + 4 / 12.0), 1e-12);
  EXPECT_NEAR(with_resolution(0, 0, 6), 6 / std::sqrt(12), 1e-12);
}

}  // namespace
}  // namespace mdof::algo
