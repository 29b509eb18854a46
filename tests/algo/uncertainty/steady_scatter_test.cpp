// The scatter of visits beside a change in proportion to time, by least squares of one slope and a
// mean of each place, worked out anew.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <map>
#include <random>
#include <utility>

#include "algo/iso230/target_means.h"
#include "algo/uncertainty/statistics/visit_scatter.h"

namespace mdof::algo {
namespace {

struct TimedVisits {
  std::vector<MeasuredPoint> points;
  std::vector<Errors5> values;
  std::vector<double> time_s;
};

TimedVisits timed_visits(int runs, double per_s) {
  TimedVisits all;
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  double t = 100;
  for (int run = 1; run <= runs; ++run)
    for (const int direction : {1, -1})
      for (int target = 1; target <= 4; ++target) {
        MeasuredPoint p;
        p.run = run;
        p.target = direction > 0 ? target : 5 - target;
        p.point.direction = direction;
        p.errors.valid = !(run == 2 && target == 3);
        all.points.push_back(p);
        t += 2 + 0.3 * target;
        all.time_s.push_back(t);
        Errors5& value = all.values.emplace_back();
        for (std::size_t k = 0; k < 5; ++k)
          value[k] =
              10 * p.target + 3 * direction + per_s * t * static_cast<double>(k) + normal(engine);
      }
  return all;
}

// Sum of squares that places, and a slope over the time, leave.
std::vector<double> left_of_slope(const TimedVisits& all) {
  std::map<std::pair<int, int>, Eigen::Index> places;
  for (const MeasuredPoint& p : all.points)
    if (p.errors.valid) places.emplace(std::pair(p.target, p.point.direction), places.size());
  const auto n = static_cast<Eigen::Index>(all.points.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(places.size()) + 1);
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!all.points[at].errors.valid) continue;
    A(i, places.at({all.points[at].target, all.points[at].point.direction})) = 1;
    A(i, A.cols() - 1) = all.time_s[at];
    for (Eigen::Index k = 0; k < 5; ++k) y(i, k) = all.values[at][static_cast<std::size_t>(k)];
  }
  const Eigen::MatrixXd left = y - A * A.colPivHouseholderQr().solve(y);
  std::vector<double> squares;
  for (Eigen::Index k = 0; k < 5; ++k) squares.push_back(left.col(k).squaredNorm());
  return squares;
}

TEST(SteadyScatter, IsWhatASlopeOverTheTimeLeaves) {
  for (const double per_s : {0.0, 2.0}) {
    const TimedVisits all = timed_visits(3, per_s);
    const VisitScatter scatter(all.points);
    const auto found = scatter.of_steady(all.values, all.time_s);
    const std::vector<double> squares = left_of_slope(all);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(found.variance[k], squares[k] / (22 - 8 - 1), 1e-9 * squares[k]);
  }
}

// Without a time that goes on nothing can be taken.
TEST(SteadyScatter, AtOneTimeIsThatOfTheVisits) {
  TimedVisits all = timed_visits(3, 0);
  const VisitScatter scatter(all.points);
  all.time_s.assign(all.time_s.size(), 5);
  EXPECT_EQ(scatter.of_steady(all.values, all.time_s).variance, scatter.of(all.values).variance);
  EXPECT_EQ(scatter.of_steady(all.values, all.time_s).freedom, scatter.of(all.values).freedom);
}

// Of one degree of freedom a slope would leave none.
TEST(SteadyScatter, OfTwoVisitsOfOnePlace) {
  TimedVisits all = timed_visits(1, 0);
  MeasuredPoint again = all.points[2];
  again.run = 2;
  all.points.push_back(again);
  all.values.push_back(all.values[2]);
  for (double& v : all.values.back()) v += 4;
  all.time_s.push_back(1000);
  const auto found = VisitScatter(all.points).of_steady(all.values, all.time_s);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(found.variance[k], 8, 1e-9);
    EXPECT_EQ(found.freedom[k], 1);  // not 64/25, as passes and the rest have one together
  }
}

// Runs whose own means are 2, 4 and 9 (k + 1), each the middle of its two ways, which differ by 6:
// of the mean of both s/√3 with s² = 13, above what the ways make of it by themselves.
TEST(TargetMeansByHand, TheMeanOfBothWaysHasTheScatterOfTheRuns) {
  std::vector<MeasuredPoint> points;
  const double of_run[] = {2, 4, 9};
  for (int run = 1; run <= 3; ++run)
    for (const int direction : {1, -1}) {
      MeasuredPoint p;
      p.run = run;
      p.target = 1;
      p.point.direction = direction;
      p.errors.valid = true;
      Errors5 named{};
      for (std::size_t k = 0; k < 5; ++k)
        named[k] = static_cast<double>(k + 1) * (of_run[run - 1] + 3 * direction);
      p.errors.local = local_from_named(Axis::x, named);
      points.push_back(p);
    }
  const auto means = target_means({Axis::x, {}}, points, Approach::both);
  ASSERT_EQ(means.size(), 1U);
  EXPECT_EQ(means[0].target, 1);
  EXPECT_EQ(means[0].n, 6U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(means[0].named[k], 5 * static_cast<double>(k + 1), 1e-12);
    EXPECT_NEAR(means[0].u[k], std::sqrt(13. / 3) * static_cast<double>(k + 1), 1e-12);
  }
}

}  // namespace
}  // namespace mdof::algo
