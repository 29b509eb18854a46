// Thinning is compared with all possible choices of points. Invalid input must be refused.
#include "algo/compensation/thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

using ManyColumns = std::vector<std::vector<double>>;

// Largest deviation of an omitted point from the straight lines between the chosen points. Bit i of
// `chosen` selects point i.
double worst_deviation_of_points(const std::vector<double>& x, const ManyColumns& columns,
                                 unsigned chosen) {
  double worst = 0;
  std::size_t before = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (!(chosen >> i & 1)) continue;
    for (std::size_t k = before + 1; k < i; ++k)
      for (const auto& y : columns) {
        const double line =
            y[before] + (y[i] - y[before]) * (x[k] - x[before]) / (x[i] - x[before]);
        worst = std::max(worst, std::abs(line - y[k]));
      }
    before = i;
  }
  return worst;
}

TEST(Thinning, KeepsTheFewestPossiblePoints) {
  std::vector<double> x;
  ManyColumns columns(2);
  for (int i = 0; i < 13; ++i) {
    x.push_back(i + 0.3 * std::sin(3.0 * i));
    columns[0].push_back(std::sin(0.7 * i) + 0.1 * std::cos(5.0 * i));
    columns[1].push_back(std::sin(0.7 * i + 0.2));
  }
  for (const double tolerance : {0.01, 0.05, 0.1, 0.2, 0.4, 1.0, 3.0}) {
    std::size_t fewest_points = x.size();
    for (unsigned chosen = 0; chosen < (1U << 13); ++chosen) {
      const bool ends = (chosen & 1) && (chosen >> 12 & 1);
      if (ends && worst_deviation_of_points(x, columns, chosen) <= tolerance)
        fewest_points =
            std::min(fewest_points, static_cast<std::size_t>(__builtin_popcount(chosen)));
    }
    const auto thin = thinned(x, columns, tolerance).value();
    unsigned chosen = 0;
    for (const std::size_t i : thin.kept) chosen |= 1U << i;
    EXPECT_EQ(thin.kept.size(), fewest_points) << tolerance;
    EXPECT_LE(thin.largest_deviation, tolerance);
    EXPECT_NEAR(thin.largest_deviation, worst_deviation_of_points(x, columns, chosen), 1e-15);
  }
}

TEST(Thinning, ZeroToleranceKeepsAllPoints) {
  EXPECT_EQ(thinned({0, 1, 2}, {{0, 0, 0}}, 0).value().kept, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(thinned({0, 1, 2}, {{0, 0, 0}}, 1e-9).value().kept, (std::vector<std::size_t>{0, 2}));
}

TEST(Thinning, FindsTheSmallestSufficientTolerance) {
  std::vector<double> x;
  ManyColumns columns(1);
  for (int i = 0; i < 257; ++i) {
    x.push_back(i);
    columns[0].push_back(std::sin(0.05 * i * i));
  }
  const double enough = tolerance_for(x, columns, 200).value();
  EXPECT_LE(thinned(x, columns, enough).value().kept.size(), 200u);
  EXPECT_GT(thinned(x, columns, enough * 0.97).value().kept.size(), 200u);
  EXPECT_EQ(tolerance_for(x, columns, 257).value(), 0);
}

TEST(Thinning, RefusesInvalidInput) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(thinned({}, {}, 1));
  EXPECT_FALSE(thinned({0}, {{1}}, 1));
  EXPECT_FALSE(thinned({0, 0}, {{1, 2}}, 1));
  EXPECT_FALSE(thinned({0, 1}, {{1}}, 1));
  EXPECT_FALSE(thinned({0, 1}, {{1, 2}}, -1));
  EXPECT_FALSE(thinned({0, 1}, {{1, 2}}, kMissing));
  EXPECT_NE(thinned({0, 1}, {{1, kMissing}}, 1).error().message.find("position 2"),
            std::string::npos);
  EXPECT_FALSE(tolerance_for({0, 1}, {{1, 2}}, 1));
}

TEST(Thinning, ZeroToleranceHasNoDeviation) {
  const auto all = thinned({0, 1, 2, 5}, {{0, 1, 5, 2}}, 0);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->kept, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(all->largest_deviation, 0);
}

}  // namespace
}  // namespace mdof::algo
