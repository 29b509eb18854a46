// Tests the random errors of visits, and the intervals of ranges and of repeatabilities, for a few
// visits and trials that are calculated by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "algo/uncertainty/positioning/repeatability_interval.h"
#include "algo/uncertainty/statistics/independent_parts.h"
#include "algo/uncertainty/statistics/range_interval.h"
#include "algo/uncertainty/statistics/repeatability.h"
#include "algo/uncertainty/statistics/visit_scatter.h"

namespace mdof::algo {
namespace {

constexpr double kInfiniteFreedom = std::numeric_limits<double>::infinity();

MeasuredPoint visit_by_hand(int target, int run, int direction, const Errors5& named,
                            double noise_u = 0) {
  MeasuredPoint p;
  p.target = target;
  p.run = run;
  p.point.direction = direction;
  p.point.position_m = p.target_m = 0.01 * target;
  p.errors.valid = true;
  p.errors.local = local_from_named(Axis::x, named);
  for (std::size_t k = 0; k < 5; ++k) p.errors.covariance[6 * k] = noise_u * noise_u;
  return p;
}

// Two runs of three targets in both directions. All visits of a pass deviate by s, and the visit of
// each target deviates by d in addition; the sum of d over a pass is 0.
// Run 1, forward: s = 3, d = 1, 0, -1.
// Run 1, reverse: s = 5, d = 2, -1, -1.
// Run 2 has the opposite signs. The mean of a target is 100 times its number, 7 less in reverse.
// Error k has k + 1 times these values.
constexpr double kShift[] = {3, 5};
constexpr double kOff[2][3] = {{1, 0, -1}, {2, -1, -1}};
constexpr double kSumOfSquaredDeviations = 2 * (1 + 1) + 2 * (4 + 1 + 1);  // sum of d² of both runs
std::vector<MeasuredPoint> two_runs_by_hand(double noise_u = 0) {
  std::vector<MeasuredPoint> points;
  for (const int run : {1, 2})
    for (const int way : {0, 1})
      for (int t = 0; t < 3; ++t) {
        const double sign = run == 1 ? 1 : -1;
        const double value = 100 * (t + 1) - 7 * way + sign * (kShift[way] + kOff[way][t]);
        Errors5 named{};
        for (std::size_t k = 0; k < 5; ++k) named[k] = static_cast<double>(k + 1) * value;
        points.push_back(visit_by_hand(t + 1, run, way == 0 ? 1 : -1, named, noise_u));
      }
  return points;
}
Repeatability repeatability_by_hand(const std::vector<MeasuredPoint>& points) {
  const MovingAxis x;
  return repeatability(x, points, target_means(x, points, Approach::both));
}

// 12 visits less 6 means of targets and directions less 2 differences of passes (one for each
// direction) give 4 degrees of freedom.
TEST(RepeatabilityByHand, IsTheScatterWithoutThePasses) {
  const Repeatability found = repeatability_by_hand(two_runs_by_hand());
  const double variance = kSumOfSquaredDeviations / 4;
  EXPECT_NEAR(found.freedom, 4, 1e-12);
  EXPECT_NEAR(found.shift_freedom, 1, 1e-12);
  ASSERT_EQ(found.u.size(), 3u);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto by = static_cast<double>(k + 1);
    EXPECT_TRUE(found.by_scatter[k]);
    EXPECT_NEAR(found.u_visit[k], by * std::sqrt(variance), 1e-9);
    for (const Errors5& u : found.u) EXPECT_NEAR(u[k], by * std::sqrt(variance / 4), 1e-9);
    // The means of the two runs deviate by ±(3 + 5)/2 from their mean: a variance of 32 with one
    // degree of freedom. The contribution of the scatter to a mean of six visits is subtracted. The
    // mean of two runs has half of this variance.
    EXPECT_NEAR(found.u_shift[k], by * std::sqrt((32 - variance / 6) / 2), 1e-9);
  }
}

// Visits that have no errors or whose approach is unknown are ignored.
TEST(RepeatabilityByHand, IgnoresInvalidVisits) {
  auto points = two_runs_by_hand();
  const Repeatability without = repeatability_by_hand(points);
  const Errors5 far = {900, 900, 900, 900, 900};
  points.push_back(visit_by_hand(1, 1, 0, far));
  points.push_back(visit_by_hand(2, 2, 1, far));
  points.back().errors.valid = false;
  const Repeatability found = repeatability_by_hand(points);
  EXPECT_EQ(found.freedom, without.freedom);
  EXPECT_EQ(found.u, without.u);
  EXPECT_EQ(found.u_shift, without.u_shift);
}

// The scatter is used if its variance exceeds 1 + 0.84 sqrt(2/4) times the variance of the noise.
// The variance 4 exceeds this limit if the variance of the noise is below 2.51.
TEST(RepeatabilityByHand, ScatterIsUsedIfItExceedsTheNoise) {
  auto of_first = [](double noise_variance) {
    const Repeatability found = repeatability_by_hand(two_runs_by_hand(std::sqrt(noise_variance)));
    return std::pair(found.by_scatter[0], found.u[0][0]);
  };
  EXPECT_EQ(of_first(2.48).first, true);
  EXPECT_NEAR(of_first(2.48).second, 1, 1e-9);  // sqrt(4/4)
  EXPECT_EQ(of_first(2.54).first, false);
  EXPECT_NEAR(of_first(2.54).second, std::sqrt(2.54 / 4), 1e-9);
  EXPECT_NEAR(of_first(9).second, 1.5, 1e-9);
}

// The variance of the scatter is divided among the targets in proportion to the variance of their
// noise: 1, 4 and 1, with the mean 2.
TEST(RepeatabilityByHand, IsSharedInProportionToTheNoise) {
  auto points = two_runs_by_hand(1e-3);
  for (MeasuredPoint& p : points)
    if (p.target == 2)
      for (std::size_t k = 0; k < 5; ++k) p.errors.covariance[6 * k] *= 4;
  const Repeatability found = repeatability_by_hand(points);
  EXPECT_NEAR(found.u[0][0], std::sqrt(4 / 4.0 * 1 / 2), 1e-9);
  EXPECT_NEAR(found.u[1][0], std::sqrt(4 / 4.0 * 4 / 2), 1e-9);
  EXPECT_NEAR(found.u[2][0], std::sqrt(4 / 4.0 * 1 / 2), 1e-9);
}

TEST(RepeatabilityByHand, IsTheNoiseForOneRun) {
  auto points = two_runs_by_hand(0.5);
  points.resize(6);
  points.push_back(visit_by_hand(2, 1, 0, {}));  // unknown approach
  const Repeatability found = repeatability_by_hand(points);
  EXPECT_EQ(found.freedom, kInfiniteFreedom);
  EXPECT_EQ(found.shift_freedom, kInfiniteFreedom);
  EXPECT_FALSE(found.by_scatter[0]);
  EXPECT_EQ(found.u_shift, Errors5{});
  for (const Errors5& u : found.u) EXPECT_NEAR(u[0], 0.5 / std::sqrt(2), 1e-12);
}

// In one direction, the mean of a target contains only two visits.
TEST(RepeatabilityByHand, IsCorrectForOneDirection) {
  std::vector<MeasuredPoint> forward;
  for (const MeasuredPoint& p : two_runs_by_hand())
    if (p.point.direction > 0) forward.push_back(p);
  const Repeatability found = repeatability_by_hand(forward);
  EXPECT_NEAR(found.freedom, 2, 1e-12);  // 6 visits, 3 means of targets, 2 passes minus 1 direction
  const double variance = 4 / 2.0;
  EXPECT_NEAR(found.u[0][0], std::sqrt(variance / 2), 1e-9);
  EXPECT_NEAR(found.u_shift[0], std::sqrt((2 * 9 - variance / 3) / 2), 1e-9);
}

// Target 3 has visits in one direction only. Its mean is corrected with the mean reversal of the
// other targets, and the u of the target is the u of this mean.
TEST(RepeatabilityByHand, OneDirectionTargetHasTheUOfItsMean) {
  std::vector<MeasuredPoint> points;
  for (const MeasuredPoint& p : two_runs_by_hand())
    if (p.target != 3 || p.point.direction > 0) points.push_back(p);
  const auto means = target_means(MovingAxis{}, points, Approach::both);
  const Repeatability found = repeatability(MovingAxis{}, points, means);
  EXPECT_EQ(found.u[2], means[2].u);
  EXPECT_NE(found.u[1], means[1].u);
}

// Sum of squares about the six means: 2 (3 (9 + 25) + 2 + 6) = 220, with 6 degrees of freedom. The
// part of the means of the passes is 2 * 3 (9 + 25) = 204, with 2 degrees of freedom.
TEST(VisitScatterByHand, PoolsVisitsAndPasses) {
  auto points = two_runs_by_hand();
  std::vector<Errors5> values;
  for (const MeasuredPoint& p : points) values.push_back(named_from_local(Axis::x, p.errors.local));
  // A point whose approach is unknown is ignored.
  points.insert(points.begin() + 4, visit_by_hand(1, 1, 0, {}));
  values.insert(values.begin() + 4, Errors5{1e6, 1e6, 1e6, 1e6, 1e6});
  const VisitScatter scatter(points);
  EXPECT_TRUE(scatter.has_repeats());
  EXPECT_FALSE(scatter.are_single());
  const auto pooled = scatter.of(values);
  const double freedom = 220. * 220 / 36 / (204. * 204 / 36 / 2 + 16. * 16 / 36 / 4);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto by = static_cast<double>((k + 1) * (k + 1));
    EXPECT_NEAR(pooled.variance[k], by * 220 / 6, 1e-9);
    EXPECT_NEAR(pooled.freedom[k], freedom, 1e-9);
  }
}

TEST(VisitScatterByHand, IsZeroForSingleVisits) {
  auto points = two_runs_by_hand();
  points.resize(6);
  const VisitScatter single(points);
  EXPECT_FALSE(single.has_repeats());
  EXPECT_TRUE(single.are_single());
  EXPECT_EQ(single.of(std::vector<Errors5>(6, Errors5{1, 1, 1, 1, 1})).variance, Errors5{});
  const VisitScatter none({});
  EXPECT_FALSE(none.has_repeats());
  EXPECT_FALSE(none.are_single());
}

// One target is visited three times in one run. There is only one pass, so its mean gives no
// information about the scatter of passes.
TEST(VisitScatterByHand, IsCorrectForOneTargetInOneRun) {
  const std::vector<MeasuredPoint> points(3, visit_by_hand(1, 1, -1, {}));
  const auto pooled = VisitScatter(points).of({{1, 0, 0, 0, 0}, {2, 0, 0, 0, 0}, {6, 0, 0, 0, 0}});
  EXPECT_NEAR(pooled.variance[0], (4 + 1 + 9) / 2.0, 1e-12);
  EXPECT_NEAR(pooled.freedom[0], 2, 1e-12);
}

// Two deviations differ by 100. In the trials the second deviation changes by 1, 2 ... n, and the
// range changes by the same amount.
TEST(RangeIntervalByHand, IsThe95PercentPointOfItsChange) {
  for (const std::size_t n : {20u, 100u}) {
    std::vector<double> changes;
    for (std::size_t t = n; t > 0; --t) {
      changes.push_back(0);
      changes.push_back(static_cast<double>(t));
    }
    // The 95 % point is the sorted change number 0.95 n, counted from 0.
    const double expected = n == 20 ? 20 : 96;
    EXPECT_NEAR(RangeTrials({0, 100}, changes).U(), expected, 1e-9);
    // Changes with the opposite sign give the same result.
    for (double& c : changes) c = -c;
    EXPECT_NEAR(RangeTrials({0, -100}, changes).U(), expected, 1e-9);
    // If the measured range is smaller than U, the true range may be 0.
    EXPECT_NEAR(RangeTrials({0, -7}, changes).U(), expected, 1e-9);
  }
}

// The deviations are 0, 5 and 10; the trial has errors of 6 in the middle and 1 at the top. If both
// ends are reduced by U/2, the range of the trial exceeds the reduced range by 1 + U/2. This equals
// U for U = 2.
TEST(RangeIntervalByHand, CoversTheBiasOfASmallerTrueRange) {
  EXPECT_NEAR(RangeTrials({0, 5, 10}, {0, 6, 1}).U(), 2, 1e-9);
  EXPECT_NEAR(RangeTrials({10, 0, 5}, {1, 0, 6}).U(), 2, 1e-9);
}

TEST(RangeIntervalByHand, SpreadMatchesTheTrials) {
  // The ranges of the trials are 8, 14 and 11.
  const RangeTrials trials({1, 4, 11}, {0, 0, -2, 0, 0, 4, 0, 0, 1});
  EXPECT_NEAR(trials.standard_deviation(), 3, 1e-12);
  EXPECT_NEAR(trials.root_mean_square(10), std::sqrt((4 + 16 + 1) / 3.0), 1e-12);
  // With a true range of 0, all true deviations are 6, and the ranges are 2, 4 and 1.
  EXPECT_NEAR(trials.root_mean_square(0), std::sqrt((4 + 16 + 1) / 3.0), 1e-12);
  // With a true range of 6, they are 3, 4 and 9, and the ranges of the trials are 4, 10 and 7.
  EXPECT_NEAR(trials.root_mean_square(6), std::sqrt((4 + 16 + 1) / 3.0), 1e-12);
  EXPECT_EQ(RangeTrials({1, 4}, {0, 2}).standard_deviation(), 0);
}

// Visits and their standard deviations s:
// Target 1, reverse: 1, 3, 5 (s = 2); forward: 10, 11, 12 (s = 1).
// Target 2, reverse: 0, 0, 3 (s = sqrt 3); forward: 2, 4, 6 (s = 2).
VisitGroups groups_by_hand() {
  return {{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 2};
}
const std::vector<double> kVisitsByHand = {1, 10, 0, 2, 3, 11, 0, 4, 5, 12, 3, 6};

TEST(RepeatabilityOfVisits, MatchesTheStandard) {
  const VisitGroups groups = groups_by_hand();
  const double* values = kVisitsByHand.data();
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::forward), 8, 1e-12);
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::reverse), 8, 1e-12);
  // R = 2 * 2 + 2 * 1 + |11 - 3| at target 1.
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::both), 14, 1e-12);
  // If the signs are changed, forward is lower than reverse, and R is the same.
  std::vector<double> mirrored = kVisitsByHand;
  for (double& v : mirrored) v = -v;
  EXPECT_NEAR(repeatability_R(groups, mirrored.data(), RepeatabilityKind::both), 14, 1e-12);
  // Without a reversal, R is four times the larger s.
  const VisitGroups one{{0, 0, 1, 1}, 1};
  const std::vector<double> still = {0, 0, -1, 1};
  EXPECT_NEAR(repeatability_R(one, still.data(), RepeatabilityKind::both), 4 * std::sqrt(2), 1e-12);
  const std::vector<double> moving = {-1, 1, 0, 0};
  EXPECT_NEAR(repeatability_R(one, moving.data(), RepeatabilityKind::both), 4 * std::sqrt(2),
              1e-12);
  EXPECT_EQ(repeatability_R(one, moving.data(), RepeatabilityKind::forward), 0);
}

TEST(RepeatabilityOfVisits, IsUnknownForASingleVisit) {
  const VisitGroups groups{{0, 0, 1}, 1};
  const std::vector<double> values = {0, 1, 5};
  EXPECT_TRUE(std::isnan(repeatability_R(groups, values.data(), RepeatabilityKind::forward)));
  EXPECT_TRUE(std::isnan(repeatability_R(groups, values.data(), RepeatabilityKind::both)));
  EXPECT_NEAR(repeatability_R(groups, values.data(), RepeatabilityKind::reverse),
              4 * std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(std::isnan(repeatability_U(groups, values, {0, 0, 0}, RepeatabilityKind::forward)));
}

// The errors in a trial are e times the readings, so they increase R by e R. This holds for any
// true R: U = e R. The 95 % point of the 40 trials e = 0.01, 0.02 ... is the 39th.
TEST(RepeatabilityOfVisits, UIsThe95PercentPoint) {
  const auto errors_up_to = [](double most) {
    std::vector<double> errors;
    for (int t = 40; t > 0; --t)
      for (const double v : kVisitsByHand) errors.push_back(v * most * t / 40);
    return errors;
  };
  const VisitGroups groups = groups_by_hand();
  for (const auto& [of, R] :
       {std::pair(RepeatabilityKind::forward, 8.0), std::pair(RepeatabilityKind::reverse, 8.0),
        std::pair(RepeatabilityKind::both, 14.0)}) {
    const double U = repeatability_U(groups, kVisitsByHand, errors_up_to(0.4), of);
    EXPECT_GE(U, 0.39 * R - 1e-9);
    EXPECT_LE(U, (0.39 + 1 / 256.) * R + 1e-9);
    // U is at least the 95 % point that these errors have for R = 0.
    EXPECT_NEAR(repeatability_U(groups, kVisitsByHand, errors_up_to(1.2), of), 1.17 * R, 1e-9);
  }
}

// The errors are -0.75 times the readings. If the true R is l times the R of the readings, the
// calculated R is |l - 0.75| R. The interval ends at l = 0.58, but the deviation for l = 1 is 0.75
// R.
TEST(RepeatabilityOfVisits, UIsAtLeastTheErrorOfTheReadings) {
  std::vector<double> errors;
  for (const double v : kVisitsByHand) errors.push_back(-0.75 * v);
  EXPECT_NEAR(repeatability_U(groups_by_hand(), kVisitsByHand, errors, RepeatabilityKind::both),
              0.75 * 14, 1e-9);
}

// The products of the parts add to each covariance. There are as many parts as quantities, or
// fewer.
TEST(IndependentParts, GiveTheCovariance) {
  const double covariance[4][4] = {{4, 2, 0, -1}, {2, 5, 0, 3}, {0, 0, 0, 0}, {-1, 3, 0, 9}};
  const auto of = [&](std::size_t i, std::size_t j) { return covariance[i][j]; };
  const Eigen::MatrixXd all = independent_parts(4, of, 10);
  EXPECT_EQ(all.cols(), 3);  // the variance of the third quantity is 0
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      EXPECT_NEAR(all.row(i).dot(all.row(j)), covariance[i][j], 1e-12) << i << j;
  // If fewer parts are allowed than needed, each quantity keeps its variance.
  for (const std::size_t most : {1u, 2u}) {
    const Eigen::MatrixXd some = independent_parts(4, of, most);
    EXPECT_EQ(some.cols(), static_cast<Eigen::Index>(most));
    for (const Eigen::Index i : {0, 1, 3})
      EXPECT_NEAR(some.row(i).squaredNorm(), covariance[i][i], 1e-12) << most << i;
    EXPECT_EQ(some.row(2).norm(), 0);
  }
  EXPECT_EQ(independent_parts(1, of, 5)(0, 0), 2);
  EXPECT_EQ(independent_parts(0, of, 5).size(), 0);
}

// Each part is the sum of the shifts by the single quantities, weighted by the coefficients of the
// part.
TEST(IndependentParts, AreCombinedWithTheirShifts) {
  Eigen::MatrixXd rows(2, 2);
  rows << 1, 0, 0.5, -2;
  const std::vector<std::vector<Errors5>> alone = {{{1, 2, 3, 4, 5}, {10, 0, 0, 0, 0}},
                                                   {{0, 0, 1, 0, 0}, {0, 4, 0, 0, 0}}};
  const auto parts = combined(rows, alone);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0], (std::vector<Errors5>{{1, 2, 3.5, 4, 5}, {10, 2, 0, 0, 0}}));
  EXPECT_EQ(parts[1], (std::vector<Errors5>{{0, 0, -2, 0, 0}, {0, -8, 0, 0, 0}}));
}

// Target 4 has one visit, so its residual is unknown. The residuals of the other visits are those
// of two_runs_by_hand(), and each of their visits has a quarter of the weight.
TEST(RepeatabilityByHand, ASingleVisitHasNoResidualForTheCorrelation) {
  auto points = two_runs_by_hand();
  points.insert(points.begin() + 3, visit_by_hand(4, 1, 1, {7, 8, 9, 10, 11}));
  std::vector<NoisyVisit> visits;
  for (std::size_t i = 0; i < points.size(); ++i) {
    MeasuredPoint& p = points[i];
    p.point.begin_ns = p.point.end_ns = static_cast<std::int64_t>(1'000'000'000 * i);
    const std::size_t target = static_cast<std::size_t>(p.target) - 1;
    const std::size_t way = p.point.direction > 0 ? 0 : 1;
    const bool single = p.target == 4;
    visits.push_back({target, static_cast<std::size_t>(2 * p.run) + way, static_cast<double>(i),
                      single ? 1 : 0.25,
                      single ? std::nan("") : (p.run == 1 ? 1 : -1) * kOff[way][target]});
  }
  const Repeatability found = repeatability_by_hand(points);
  EXPECT_NEAR(found.freedom, 4, 1e-12);
  const std::vector<double> weights = {1, -2, 3, 0.5};
  const auto expected = CorrelatedNoise(visits, 4).of(weights);
  ASSERT_TRUE(found.correlated[0]);
  EXPECT_NEAR(found.correlated[0]->of(weights).square, expected.square, 1e-9);
  EXPECT_NEAR(found.correlated[0]->of(weights).freedom, expected.freedom, 1e-9);
  EXPECT_GT(std::abs(expected.square - 1), 1e-3);
}

}  // namespace
}  // namespace mdof::algo
