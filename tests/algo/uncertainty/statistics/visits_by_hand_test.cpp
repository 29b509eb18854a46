// Random errors of visits, and intervals of ranges and repeatabilities, for a few visits and trials
// calculated by hand.
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

// Two runs of three targets in both directions. Each pass deviates by s, and each target of it
// additionally by d, whose sum is 0. The first run has s = 3 and d = 1, 0, -1 forward, s = 5 and d
// = 2, -1, -1 reverse; the second run has the opposite signs. The means are 100 times the target
// number, 7 lower in reverse. Error k is k + 1 times these values.
constexpr double kShift[] = {3, 5};
constexpr double kOff[2][3] = {{1, 0, -1}, {2, -1, -1}};
constexpr double kSquaresOfOff = 2 * (1 + 1) + 2 * (4 + 1 + 1);  // both runs
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

// 12 visits, 6 targets and directions, 4 passes minus 2 directions: 4 degrees of freedom.
TEST(RepeatabilityByHand, IsTheScatterWithoutThePasses) {
  const Repeatability found = repeatability_by_hand(two_runs_by_hand());
  const double variance = kSquaresOfOff / 4;
  EXPECT_NEAR(found.freedom, 4, 1e-12);
  EXPECT_NEAR(found.shift_freedom, 1, 1e-12);
  ASSERT_EQ(found.u.size(), 3u);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto by = static_cast<double>(k + 1);
    EXPECT_TRUE(found.by_scatter[k]);
    for (const Errors5& u : found.u) EXPECT_NEAR(u[k], by * std::sqrt(variance / 4), 1e-9);
    // The mean of a run deviates by ±(3 + 5)/2: a variance of 32 with one degree of freedom, minus
    // the contribution of the scatter to a mean of six visits. The mean of two runs has half of it.
    EXPECT_NEAR(found.u_shift[k], by * std::sqrt((32 - variance / 6) / 2), 1e-9);
  }
}

// Visits without errors or with unknown approach do not count.
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

// The scatter counts if its variance exceeds 1 + 0.84 sqrt(2/4) times that of the noise: the
// variance 4 exceeds a noise variance below 2.51.
TEST(RepeatabilityByHand, ScatterCountsIfItExceedsTheNoise) {
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

// The visits of a noisier target have a larger share of the scatter: variances of 1, 4 and 1 have
// the mean 2.
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

// With one direction, the mean at a target has only two visits.
TEST(RepeatabilityByHand, IsCorrectForOneDirection) {
  std::vector<MeasuredPoint> forward;
  for (const MeasuredPoint& p : two_runs_by_hand())
    if (p.point.direction > 0) forward.push_back(p);
  const Repeatability found = repeatability_by_hand(forward);
  EXPECT_NEAR(found.freedom, 2, 1e-12);  // 6 visits, 3 targets, 2 passes less 1
  const double variance = 4 / 2.0;
  EXPECT_NEAR(found.u[0][0], std::sqrt(variance / 2), 1e-9);
  EXPECT_NEAR(found.u_shift[0], std::sqrt((2 * 9 - variance / 3) / 2), 1e-9);
}

// A target with one direction in all runs takes the mean reversal of the others; its u is the u of
// its mean.
TEST(RepeatabilityByHand, OneDirectionTargetHasTheUOfItsMean) {
  std::vector<MeasuredPoint> points;
  for (const MeasuredPoint& p : two_runs_by_hand())
    if (p.target != 3 || p.point.direction > 0) points.push_back(p);
  const auto means = target_means(MovingAxis{}, points, Approach::both);
  const Repeatability found = repeatability(MovingAxis{}, points, means);
  EXPECT_EQ(found.u[2], means[2].u);
  EXPECT_NE(found.u[1], means[1].u);
}

// Squares about the six means: 2 (3 (9 + 25) + 2 + 6) = 220 with 6 degrees of freedom; the means of
// the passes alone: 2 * 3 (9 + 25) = 204 with 2.
TEST(VisitScatterByHand, PoolsVisitsAndPasses) {
  auto points = two_runs_by_hand();
  std::vector<Errors5> values;
  for (const MeasuredPoint& p : points) values.push_back(named_from_local(Axis::x, p.errors.local));
  // Points that do not count are skipped.
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

// A target that is visited again in one run: there is one pass, so its mean gives no information
// about passes.
TEST(VisitScatterByHand, IsCorrectForOneTargetInOneRun) {
  const std::vector<MeasuredPoint> points(3, visit_by_hand(1, 1, -1, {}));
  const auto pooled = VisitScatter(points).of({{1, 0, 0, 0, 0}, {2, 0, 0, 0, 0}, {6, 0, 0, 0, 0}});
  EXPECT_NEAR(pooled.variance[0], (4 + 1 + 9) / 2.0, 1e-12);
  EXPECT_NEAR(pooled.freedom[0], 2, 1e-12);
}

// Two deviations 100 apart; the second one changes by 1, 2 ... n, and the range by the same amount.
TEST(RangeIntervalByHand, IsThe95PercentPointOfItsChange) {
  for (const std::size_t n : {20u, 100u}) {
    std::vector<double> changes;
    for (std::size_t t = n; t > 0; --t) {
      changes.push_back(0);
      changes.push_back(static_cast<double>(t));
    }
    // The 95 % point of n distances, from 0 on.
    const double expected = n == 20 ? 20 : 96;
    EXPECT_NEAR(RangeTrials({0, 100}, changes).U(), expected, 1e-9);
    // The opposite signs give the same result.
    for (double& c : changes) c = -c;
    EXPECT_NEAR(RangeTrials({0, -100}, changes).U(), expected, 1e-9);
    // A range below U may be 0.
    EXPECT_NEAR(RangeTrials({0, -7}, changes).U(), expected, 1e-9);
  }
}

// 0, 5 and 10, with errors of 6 in the middle and 1 at the top. If U/2 is cut off at both ends, the
// range is 1 + U/2 larger than the true one, which is U for U = 2.
TEST(RangeIntervalByHand, CoversTheBiasOfASmallerTrueRange) {
  EXPECT_NEAR(RangeTrials({0, 5, 10}, {0, 6, 1}).U(), 2, 1e-9);
  EXPECT_NEAR(RangeTrials({10, 0, 5}, {1, 0, 6}).U(), 2, 1e-9);
}

TEST(RangeIntervalByHand, SpreadMatchesTheTrials) {
  const RangeTrials trials({1, 4, 11}, {0, 0, -2, 0, 0, 4, 0, 0, 1});  // ranges 8, 14, 11
  EXPECT_NEAR(trials.standard_deviation(), 3, 1e-12);
  EXPECT_NEAR(trials.root_mean_square(), std::sqrt((4 + 16 + 1) / 3.0), 1e-12);
  EXPECT_EQ(RangeTrials({1, 4}, {0, 2}).standard_deviation(), 0);
}

// Target 1: reverse 1, 3, 5 (s 2), forward 10, 11, 12 (s 1). Target 2: reverse 0, 0, 3 (s sqrt 3),
// forward 2, 4, 6 (s 2).
VisitGroups groups_by_hand() {
  return {{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 2};
}
const std::vector<double> kVisitsByHand = {1, 10, 0, 2, 3, 11, 0, 4, 5, 12, 3, 6};

TEST(RepeatabilityOfVisits, MatchesTheStandard) {
  const VisitGroups groups = groups_by_hand();
  const double* values = kVisitsByHand.data();
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::forward), 8, 1e-12);
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::reverse), 8, 1e-12);
  // 2 * 2 + 2 * 1 + |11 - 3| at target 1.
  EXPECT_NEAR(repeatability_R(groups, values, RepeatabilityKind::both), 14, 1e-12);
  // Forward lower than reverse gives the same result.
  std::vector<double> mirrored = kVisitsByHand;
  for (double& v : mirrored) v = -v;
  EXPECT_NEAR(repeatability_R(groups, mirrored.data(), RepeatabilityKind::both), 14, 1e-12);
  // Without a reversal, the larger scatter counts four times.
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

// Errors of e times the readings increase R by e R, for any true R: U = e R. The 95 % point of 40
// trials of 0.01, 0.02 ... is the 39th.
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
    // U is at least as large as the errors give for R = 0.
    EXPECT_NEAR(repeatability_U(groups, kVisitsByHand, errors_up_to(1.2), of), 1.17 * R, 1e-9);
  }
}

// The errors reduce the readings by three quarters: a true part l of them is read as |l - 0.75| R.
// The interval ends at l = 0.58, but the deviation for the readings themselves is 0.75 R.
TEST(RepeatabilityOfVisits, UIsAtLeastTheErrorOfTheReadings) {
  std::vector<double> errors;
  for (const double v : kVisitsByHand) errors.push_back(-0.75 * v);
  EXPECT_NEAR(repeatability_U(groups_by_hand(), kVisitsByHand, errors, RepeatabilityKind::both),
              0.75 * 14, 1e-9);
}

// The squares of the parts add to each covariance, for as many parts as quantities or fewer.
TEST(IndependentParts, HaveTheCovariance) {
  const double covariance[4][4] = {{4, 2, 0, -1}, {2, 5, 0, 3}, {0, 0, 0, 0}, {-1, 3, 0, 9}};
  const auto of = [&](std::size_t i, std::size_t j) { return covariance[i][j]; };
  const Eigen::MatrixXd all = independent_parts(4, of, 10);
  EXPECT_EQ(all.cols(), 3);  // the third quantity is 0
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      EXPECT_NEAR(all.row(i).dot(all.row(j)), covariance[i][j], 1e-12) << i << j;
  // With fewer parts than needed, each quantity keeps its variance.
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

// Each part is the weighted sum of the shifts of the quantities.
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

}  // namespace
}  // namespace mdof::algo
