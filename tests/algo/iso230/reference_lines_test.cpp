// The three reference lines are compared with the example in the manual of a laser interferometer;
// the minimum zone is also compared with an exhaustive search.
#include "algo/iso230/reference_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "algo/iso230/minimum_zone.h"

namespace mdof::algo {
namespace {

using Values = std::vector<double>;

Values scaled(Values values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

const Values kFirst_m = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
const Values kFirst_um = {-0.3, 0.9, 1.5, 2.5, 2.9, 3.6, 4.2, 5.1, 5.9, 7.2};
const Values kSecond_m = scaled(kFirst_m, 0.5);
const Values kSecond_um = {-0.5, -1.2, -2.5, -3.8, -4.0, -4.8, -5.9, -6.2, -7.4, -8.8};

ReferenceLines lines_of(const Values& x_m, const Values& y_um) {
  return reference_lines(x_m, scaled(y_um, 1e-6)).value();
}

void expect_line(const ReferenceLine& line, double slope_urad, double zone_um) {
  EXPECT_NEAR(line.slope_rad * 1e6, slope_urad, 5.1e-7);
  EXPECT_NEAR(line.zone_m * 1e6, zone_um, 5.1e-7);
}

TEST(ReferenceLines, MatchTheManual) {
  const ReferenceLines first = lines_of(kFirst_m, kFirst_um);
  expect_line(first.end_point, 8.333333, 0.866667);
  expect_line(first.least_squares, 7.654545, 0.703636);
  expect_line(first.minimum_zone, 7.833333, 0.650000);
  EXPECT_NEAR(first.least_squares.intercept_m * 1e6, -0.094545, 5.1e-7);
  EXPECT_NEAR(first.end_point.intercept_m * 1e6, -0.3, 1e-12);
  const ReferenceLines second = lines_of(kSecond_m, kSecond_um);
  expect_line(second.end_point, -18.444444, 1.288889);
  expect_line(second.least_squares, -17.418182, 1.083636);
  expect_line(second.minimum_zone, -16.666667, 0.933333);
  EXPECT_NEAR(second.least_squares.intercept_m * 1e6, -0.590909, 5.1e-7);
  EXPECT_EQ(first.readings, 10u);
  EXPECT_EQ(first.last_m, 0.9);
}

TEST(ReferenceLines, MinimumZoneIsCentredOnItsLine) {
  const ReferenceLine line = lines_of(kFirst_m, kFirst_um).minimum_zone;
  double high = -1, low = 1;
  for (std::size_t i = 0; i < kFirst_m.size(); ++i) {
    const double left = kFirst_um[i] * 1e-6 - line.intercept_m - line.slope_rad * kFirst_m[i];
    high = std::max(high, left);
    low = std::min(low, left);
  }
  EXPECT_NEAR(high, line.zone_m / 2, 1e-18);
  EXPECT_NEAR(low, -line.zone_m / 2, 1e-18);
}

// The deviations at 0, 1, 2, 3 are 0, 3, 0, 3. The least-squares line is 0.6 x + 0.6; the residuals
// are -0.6, 1.8, -1.8, 0.6.
TEST(ReferenceLines, ResidualIsTheRootMeanSquare) {
  const ReferenceLine line = reference_lines(Values{0, 1, 2, 3}, Values{0, 3, 0, 3})->least_squares;
  EXPECT_DOUBLE_EQ(line.slope_rad, 0.6);
  EXPECT_NEAR(line.residual_m, std::sqrt((0.36 + 3.24 + 3.24 + 0.36) / 4), 1e-15);
}

// Width of the minimum zone. The narrowest zone touches two readings on one side, so the slopes of
// all pairs of readings are tried.
double zone_by_brute_force(const Values& x, const Values& y) {
  const auto zone = [&](double slope) {
    double high = -1e9, low = 1e9;
    for (std::size_t i = 0; i < x.size(); ++i) {
      high = std::max(high, y[i] - slope * x[i]);
      low = std::min(low, y[i] - slope * x[i]);
    }
    return high - low;
  };
  double least = 1e9;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (x[i] != x[j]) least = std::min(least, zone((y[i] - y[j]) / (x[i] - x[j])));
  return least;
}

TEST(MinimumZone, MatchesBruteForceForTenThousandSeries) {
  std::mt19937_64 random(230);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0, compared = 0; compared < 10000; ++trial) {
    Values x(static_cast<std::size_t>(3 + trial % 18)), y = x;
    for (double& v : x) v = any(random);
    for (double& v : y) v = any(random);
    const bool grid = trial % 3 == 0;  // with equal positions, collinear readings and equal widths
    if (grid)
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = std::round(3 * x[i]);
        y[i] = std::round(3 * y[i]);
      }
    const auto lines = reference_lines(x, y);
    if (!lines) continue;  // fewer than three different positions
    ++compared;
    const double expected = zone_by_brute_force(x, y);
    ASSERT_NEAR(lines->minimum_zone.zone_m, expected, 1e-12 * expected + (grid ? 2e-15 : 0))
        << "series " << trial;
    ASSERT_LE(lines->minimum_zone.zone_m, lines->least_squares.zone_m + 2e-15);
    ASSERT_LE(lines->minimum_zone.zone_m, lines->end_point.zone_m + 2e-15);
  }
}

// With the readings 0 and 1 at the start, each slope within ±0.5 has a zone of the width 1. The
// line has the middle slope.
TEST(MinimumZone, TakesTheMiddleOfEquivalentSlopes) {
  const Line line = minimum_zone_line(Values{0, 0, 1, 1}, Values{0, 1, 0.5, 0.5});
  EXPECT_DOUBLE_EQ(line.slope, 0);
  EXPECT_DOUBLE_EQ(line.intercept, 0.5);
}

TEST(ReferenceLines, DoNotDependOnTheOrderOfTheReadings) {
  std::mt19937_64 random(1);
  Values x = {0, 0, 1, 2, 2, 2, 3, 4}, y = {1, 2, 5, 3, 3, 1, 4, 9};
  const ReferenceLines before = reference_lines(x, y).value();
  for (int i = 0; i < 20; ++i) {
    const auto seed = random();
    std::mt19937_64 one(seed), same(seed);
    std::shuffle(x.begin(), x.end(), one);
    std::shuffle(y.begin(), y.end(), same);
    const ReferenceLines after = reference_lines(x, y).value();
    EXPECT_EQ(after.end_point.slope_rad, before.end_point.slope_rad);
    EXPECT_EQ(after.least_squares.residual_m, before.least_squares.residual_m);
    EXPECT_EQ(after.minimum_zone.slope_rad, before.minimum_zone.slope_rad);
  }
  EXPECT_EQ(before.positions, 5u);
  // The end points are (0, 1.5), where 1.5 is the mean of two readings, and (4, 9).
  EXPECT_DOUBLE_EQ(before.end_point.slope_rad, 7.5 / 4);
  EXPECT_DOUBLE_EQ(before.end_point.intercept_m, 1.5);
}

TEST(ReferenceLines, RefuseReadingsWithoutALine) {
  const auto refused = [](const Values& x, const Values& y) {
    const auto lines = reference_lines(x, y);
    return lines ? std::string() : lines.error().message;
  };
  EXPECT_NE(refused({}, {}).find("0 readings"), std::string::npos);
  EXPECT_NE(refused({1}, {2}).find("at least three"), std::string::npos);
  EXPECT_NE(refused({1, 2}, {2, 3}).find("2 readings at 2 positions"), std::string::npos);
  EXPECT_NE(refused({5, 5, 5, 5}, {1, 2, 3, 4}).find("4 readings at only one position"),
            std::string::npos);
  EXPECT_EQ(refused({1, 2, 3}, {2, 3, 5}), "");
  constexpr double kHuge = 1e300, kNot = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {kHuge, -kHuge, kNot, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(refused({1, bad, 3}, {2, 3, 4}).find("a position is not"), std::string::npos);
    EXPECT_NE(refused({1, 2, 3}, {2, bad, 4}).find("a deviation is not"), std::string::npos);
  }
  EXPECT_NE(refused({0, 5e-324, 1e-323}, {0, 1e6, -1e6}).find("close together"), std::string::npos);
}

TEST(ReferenceLines, StraightReadingsHaveNoZone) {
  const ReferenceLines lines = reference_lines(Values{0, 1, 2, 4}, Values{1, 3, 5, 9}).value();
  for (const auto* line : {&lines.end_point, &lines.least_squares, &lines.minimum_zone}) {
    EXPECT_DOUBLE_EQ(line->slope_rad, 2);
    EXPECT_DOUBLE_EQ(line->intercept_m, 1);
    EXPECT_NEAR(line->zone_m, 0, 1e-15);
  }
}

// The time limit is 20 ms, which tools/bench/bench_iso230 measures. This test only checks that the
// time does not grow with n².
TEST(ReferenceLines, HundredThousandReadingsAreFast) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  Values x(100'000), y(100'000);
  for (double& v : x) v = any(random);
  for (double& v : y) v = std::sqrt(any(random));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(reference_lines(x, y));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1000));
}

}  // namespace
}  // namespace mdof::algo
