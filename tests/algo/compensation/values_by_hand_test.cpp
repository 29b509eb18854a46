// Repeatability of the values of a table and curvatures between its targets, for a few values that
// are calculated by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algo/compensation/between_targets.h"
#include "algo/compensation/table_uncertainty.h"

namespace mdof::algo {
namespace {

// Two runs of three targets in both directions.
// Forward values of run 1 minus their means: 3 + 1, 3 + 0, 3 - 1.
// Reverse values of run 1 minus their means: 5 + 2, 5 - 1, 5 - 1.
// In run 2 these differences have the opposite signs. The means are 7 lower in reverse than
// forward.
// Error k has k + 1 times these values.
std::vector<MeasuredPoint> table_visits() {
  const double shift[] = {3, 5}, off[2][3] = {{1, 0, -1}, {2, -1, -1}};
  std::vector<MeasuredPoint> points;
  for (const int run : {1, 2})
    for (const int way : {0, 1})
      for (int t = 0; t < 3; ++t) {
        MeasuredPoint p;
        p.target = t + 1;
        p.run = run;
        p.point.direction = way == 0 ? 1 : -1;
        p.point.position_m = p.target_m = 0.01 * t;
        p.errors.valid = true;
        const double value = 40 * t - 7 * way + (run == 1 ? 1 : -1) * (shift[way] + off[way][t]);
        Errors5 named{};
        for (std::size_t k = 0; k < 5; ++k) named[k] = static_cast<double>(k + 1) * value;
        p.errors.local = local_from_named(Axis::x, named);
        points.push_back(p);
      }
  return points;
}

SeriesOfErrors expected_series_u(const std::vector<MeasuredPoint>& points, Approach approach,
                                 const std::vector<Reference>& target_references) {
  const MovingAxis x;
  std::array<std::vector<Reference>, kErrorCount> references;
  references.fill(target_references);
  return table_uncertainty(x, points, target_means(x, points, Approach::both), approach,
                           references);
}

// In each direction, 6 visits less 3 means of targets less 1 difference of both passes give 2
// degrees of freedom. The variance of a visit is 4/2 forward and 12/2 reverse; the mean of two
// visits has half of this variance. The level of a pass has the variance 2 * 9 forward and 2 * 25
// reverse, less a third of the variance of a visit. The mean of two levels has half of this
// variance.
constexpr double kMeanVarianceForward = 1, kMeanVarianceReverse = 3;
constexpr double kLevelForward = (18 - 2 / 3.) / 2, kLevelReverse = (50 - 6 / 3.) / 2;
// Half of (forward minus reverse) deviates from its mean by -1.5, -0.5, -1 in run 1, on average by
// -1, and in run 2 by +1. This is a variance of 2, less (3.5/3 - 1)/2 from the visits; the mean of
// both runs has half of it.
constexpr double kVarianceOfMeanHalfReversal = (2 - (3.5 / 3 - 1) / 2) / 2;

void expect_u(const SeriesOfErrors& u, const std::vector<double>& variances) {
  for (std::size_t k = 0; k < 5; ++k) {
    ASSERT_EQ(u[k].size(), variances.size());
    for (std::size_t i = 0; i < variances.size(); ++i)
      EXPECT_NEAR(u[k][i], static_cast<double>(k + 1) * std::sqrt(variances[i]), 1e-9)
          << k << ' ' << i;
  }
}

TEST(TableUncertaintyByHand, MatchesForValuesAsMeasured) {
  const std::vector<Reference> none(3, as_measured(3));
  const double forward = kMeanVarianceForward + kLevelForward,
               reverse = kMeanVarianceReverse + kLevelReverse;
  expect_u(expected_series_u(table_visits(), Approach::forward, none), {forward, forward, forward});
  expect_u(expected_series_u(table_visits(), Approach::reverse, none), {reverse, reverse, reverse});
}

// The reference is the mean of both directions at the start. Each direction contributes a quarter
// of the variance of its mean.
TEST(TableUncertaintyByHand, MatchesForValuesReferredToTheStart) {
  const std::vector<Reference> from_start(3, Reference{1, 0, 0});
  const double start_variance = (kMeanVarianceForward + kMeanVarianceReverse) / 4;
  const auto later = [&](double own) { return own + start_variance + kVarianceOfMeanHalfReversal; };
  expect_u(expected_series_u(table_visits(), Approach::forward, from_start),
           {start_variance + kVarianceOfMeanHalfReversal, later(kMeanVarianceForward),
            later(kMeanVarianceForward)});
  expect_u(expected_series_u(table_visits(), Approach::reverse, from_start),
           {start_variance + kVarianceOfMeanHalfReversal, later(kMeanVarianceReverse),
            later(kMeanVarianceReverse)});
}

// The mean of both directions has a quarter of the variance of both means. Half of the difference
// of the directions cancels. As measured, the means contain a quarter of the variances of both
// levels.
TEST(TableUncertaintyByHand, MatchesForMeansOfBothDirections) {
  const double mean = (kMeanVarianceForward + kMeanVarianceReverse) / 4,
               level = (kLevelForward + kLevelReverse) / 4;
  expect_u(expected_series_u(table_visits(), Approach::both,
                             std::vector<Reference>(3, Reference{1, 0, 0})),
           {0, 2 * mean, 2 * mean});
  expect_u(
      expected_series_u(table_visits(), Approach::both, std::vector<Reference>(3, as_measured(3))),
      {mean + level, mean + level, mean + level});
  // The variance of a fitted line of three values is 5/6, 1/3 and 5/6 of that of one value.
  const std::vector<double> x = {0, 1, 2};
  expect_u(expected_series_u(table_visits(), Approach::both,
                             {line_at(x, 0), line_at(x, 1), line_at(x, 2)}),
           {mean / 6, mean * 2 / 3, mean / 6});
  auto forward_only = table_visits();
  std::erase_if(forward_only, [](const MeasuredPoint& p) { return p.point.direction < 0; });
  expect_u(expected_series_u(forward_only, Approach::both,
                             std::vector<Reference>(3, Reference{1, 0, 0})),
           {0, 2 * kMeanVarianceForward, 2 * kMeanVarianceForward});
}

// Each visit is entered twice. The sum of squares doubles and the degrees of
// freedom are 12 - 3 - 1, so the variance of a visit is half as large; the mean of four visits has
// a quarter of it. The variance of the half difference of the directions is unchanged.
TEST(TableUncertaintyByHand, VisitsOfARunAreAveraged) {
  auto points = table_visits();
  const auto once = points;
  points.insert(points.end(), once.begin(), once.end());
  const std::vector<Reference> from_start(3, Reference{1, 0, 0});
  const double forward = kMeanVarianceForward / 4,
               start_variance = (kMeanVarianceForward + kMeanVarianceReverse) / 16;
  expect_u(expected_series_u(points, Approach::forward, from_start),
           {start_variance + kVarianceOfMeanHalfReversal,
            forward + start_variance + kVarianceOfMeanHalfReversal,
            forward + start_variance + kVarianceOfMeanHalfReversal});
}

// At the first target the line has the weights 5/6, 1/3 and -1/6, in the middle 1/3 for each
// target.
TEST(TableUncertaintyByHand, MatchesForValuesReferredToTheLine) {
  const std::vector<double> x = {0, 1, 2};
  const std::vector<Reference> line = {line_at(x, 0), line_at(x, 1), line_at(x, 2)};
  const double share[3][3] = {
      {5 / 6., 1 / 3., -1 / 6.}, {1 / 3., 1 / 3., 1 / 3.}, {-1 / 6., 1 / 3., 5 / 6.}};
  std::vector<double> variances;
  for (std::size_t i = 0; i < 3; ++i) {
    double variance = kVarianceOfMeanHalfReversal;
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(line[i][j], share[i][j], 1e-12);
      const double own = (i == j ? 1 : 0) - share[i][j] / 2, other = share[i][j] / 2;
      variance += own * own * kMeanVarianceForward + other * other * kMeanVarianceReverse;
    }
    variances.push_back(variance);
  }
  expect_u(expected_series_u(table_visits(), Approach::forward, line), variances);
}

// All visits have one direction. The mean is the mean of this direction, and there is no difference
// of directions.
TEST(TableUncertaintyByHand, MatchesForOneDirection) {
  auto points = table_visits();
  std::erase_if(points, [](const MeasuredPoint& p) { return p.point.direction < 0; });
  const auto against_start =
      expected_series_u(points, Approach::forward, std::vector<Reference>(3, Reference{1, 0, 0}));
  expect_u(against_start, {0, 2 * kMeanVarianceForward, 2 * kMeanVarianceForward});
  const auto back =
      expected_series_u(points, Approach::reverse, std::vector<Reference>(3, Reference{1, 0, 0}));
  for (const auto& of_error : back)
    for (const double u : of_error) EXPECT_TRUE(std::isnan(u));
}

// A single run shows neither the scatter of visits nor the level of passes.
TEST(TableUncertaintyByHand, SingleRunHasItsNoiseOnly) {
  auto points = table_visits();
  points.resize(6);
  for (MeasuredPoint& p : points)
    for (std::size_t k = 0; k < 5; ++k)
      p.errors.covariance[6 * k] = static_cast<double>((k + 1) * (k + 1)) * 0.25;
  expect_u(expected_series_u(points, Approach::reverse, std::vector<Reference>(3, as_measured(3))),
           {0.25, 0.25, 0.25});
  expect_u(
      expected_series_u(points, Approach::forward, std::vector<Reference>(3, Reference{1, 0, 0})),
      {0.25 * (0.25 + 0.25), 0.25 * 1.5, 0.25 * 1.5});
}

constexpr double kMissingTableValue = std::numeric_limits<double>::quiet_NaN();
using Series = std::vector<double>;

// Square of the second derivative of the parabola through three values by divided differences, less
// the contribution of the u of the values.
double squared_curvature(const Series& x, const Series& y, const Series& u, std::size_t a,
                         std::size_t b, std::size_t c) {
  const auto bend = [&](double ya, double yb, double yc) {
    return 2 * ((yc - yb) / (x[c] - x[b]) - (yb - ya) / (x[b] - x[a])) / (x[c] - x[a]);
  };
  const double noise =
      std::pow(bend(u[a], 0, 0), 2) + std::pow(bend(0, u[b], 0), 2) + std::pow(bend(0, 0, u[c]), 2);
  return std::pow(bend(y[a], y[b], y[c]), 2) - noise;
}
double mean_squared_curvature(const Series& x, const Series& y, const Series& u, std::size_t step) {
  double sum = 0, n = 0;
  for (std::size_t i = step; i + step < x.size(); ++i, n += 1)
    sum += squared_curvature(x, y, u, i - step, i, i + step);
  return std::max(0.0, sum / n);
}
// Expected curvature between the values i and i + 1 by algo/README.md, from the values i - 1 to i +
// 2.
double expected_curvature(const Series& x, const Series& y, const Series& u, std::size_t i,
                          double R) {
  double near = 0, n = 0;
  for (std::size_t at = 1; at + 1 < x.size(); ++at)
    if (at + 1 >= i && at <= i + 2) {
      near += squared_curvature(x, y, u, at - 1, at, at + 1);
      n += 1;
    }
  return R * std::sqrt(std::max(0.0, 6 * mean_squared_curvature(x, y, u, 1) + near) / (6 + n));
}

TEST(CurvaturesByHand, MatchManualCalculationForThreeValues) {
  const Series found = curvatures({0, 1, 3}, {0, 1, 0}, {0.3, 0.3, 0.6});
  ASSERT_EQ(found.size(), 2u);
  // The second difference is -1. The u of the values contributes (2/3 of 0.3)² + 0.3² + (1/3 of
  // 0.6)² to its square.
  for (const double c : found) EXPECT_NEAR(c, 4 * std::sqrt(1 - 0.17), 1e-12);
  // If the noise explains the whole second difference, the curvature is 0.
  for (const double c : curvatures({0, 1, 3}, {0, 1, 0}, {0, 1.1, 0})) EXPECT_EQ(c, 0);
  for (const double c : curvatures({0, 1}, {0, 1}, {0, 0})) EXPECT_TRUE(std::isnan(c));
  EXPECT_TRUE(curvatures({}, {}, {}).empty());
  EXPECT_TRUE(curvatures({1}, {1}, {0}).empty());
}

TEST(CurvaturesByHand, FewValuesGiveTheFactorRFourOrTwo) {
  const Series x = {0, 1, 3, 4, 6, 7}, y = {0, 2, 1, 5, -1, 3}, u = {0.1, 0.2, 0.1, 0.3, 0.2, 0.1};
  for (const std::size_t n : {4u, 5u, 6u}) {
    const Series xs(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)),
        ys(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)),
        us(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(n));
    const Series found = curvatures(xs, ys, us);
    ASSERT_EQ(found.size(), n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i)
      EXPECT_NEAR(found[i], expected_curvature(xs, ys, us, i, n == 4 ? 4 : 2), 1e-12) << n << i;
  }
}

// The factor R follows from q, the ratio of the curvature over one step to the curvature over two
// steps.
TEST(CurvaturesByHand, FactorRFollowsTheRoughness) {
  const Series u(9, 0.01);
  const Series smooth = {0, 1, 4, 9, 16, 25, 36, 49, 64},  // q = 1
      wavy = {0, 1, 1.2, 0.5, -1, -2, -1.5, 0.3, 2},       // q between 1 and 2.2
      rough = {0, 1, -1, 1.5, -1, 1, -2, 1, -1};           // q above 2.2
  Series x;
  for (int i = 0; i < 9; ++i) x.push_back(i + 0.1 * (i % 2));
  double least = 9, most = 0;
  for (const Series& y : {smooth, wavy, rough}) {
    const double q = std::clamp(
        std::sqrt(mean_squared_curvature(x, y, u, 1) / mean_squared_curvature(x, y, u, 2)), 1.0,
        4.0);
    const double R = std::max(2 * std::sqrt(q) / (1 + std::sqrt(q)), q * q / 4);
    const Series found = curvatures(x, y, u);
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(found[i], expected_curvature(x, y, u, i, R), 1e-10) << i << " q " << q;
    least = std::min(least, R), most = std::max(most, R);
  }
  EXPECT_LT(least, 1.1);
  EXPECT_GT(most, 1.5);
  // The curvature over two steps is 0, so R has its maximum.
  const Series zigzag = {0, 1, 0, 1, 0, 1, 0, 1, 0};
  Series even;
  for (int i = 0; i < 9; ++i) even.push_back(i);
  for (const double c : curvatures(even, zigzag, Series(9, 0.0))) EXPECT_NEAR(c, 4 * 2, 1e-12);
  for (const double c : curvatures(even, Series(9, 3.0), Series(9, 0.1))) EXPECT_EQ(c, 0);
}

// Missing values are skipped. The interval between the neighbours of a missing value counts as one
// step.
TEST(CurvaturesByHand, MissingValuesAreSkipped) {
  const Series x = {0, 1, 3, 4, 6, 7, 9}, u = {0.1, kMissingTableValue, 0.1, 0.3, 0.2, 0.1, 0.2};
  const Series y = {kMissingTableValue, 2, 1, kMissingTableValue, -1, 3, kMissingTableValue};
  const Series found = curvatures(x, y, u);
  ASSERT_EQ(found.size(), 6u);
  const Series xs = {1, 3, 6, 7}, ys = {2, 1, -1, 3}, us = {0, 0.1, 0.2, 0.1};
  const std::size_t between[] = {0, 0, 1, 1, 2, 3};  // 3: after the last value that exists
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(found[i], expected_curvature(xs, ys, us, between[i], 4), 1e-12) << i;
}

}  // namespace
}  // namespace mdof::algo
