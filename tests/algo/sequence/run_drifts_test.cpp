// The drifts of runs are compared with a least-squares fit of all runs and visits at once, which
// eliminates no unknowns.
#include "algo/sequence/run_drifts.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <map>
#include <random>
#include <utility>

namespace mdof::algo {
namespace {

struct Case {
  std::vector<MeasuredPoint> points;
  std::vector<Errors5> errors;

  void add(int run, int target, int direction, std::mt19937& engine) {
    MeasuredPoint p;
    p.run = run;
    p.target = target;
    p.point.direction = direction;
    points.push_back(p);
    std::normal_distribution<double> normal;
    errors.emplace_back();
    for (double& e : errors.back()) e = normal(engine);
  }
};

// Least-squares solution with the smallest norm. The columns of the matrix are the runs, then the
// visits. Visits link runs to groups; the mean of each group is subtracted. The groups are found by
// copying the lowest number of a group to linked runs.
std::vector<Errors5> fit_all_runs(const Case& of) {
  std::map<int, std::size_t> runs;
  std::map<std::pair<int, int>, std::size_t> visits;
  for (const MeasuredPoint& p : of.points) {
    runs[p.run];
    visits[{p.target, p.point.direction}];
  }
  std::size_t column = 0;
  for (auto& [run, at] : runs) at = column++;
  for (auto& [visit, at] : visits) at = column++;
  const auto n = static_cast<Eigen::Index>(of.points.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(column));
  Eigen::MatrixXd y(n, 5);
  std::vector<std::size_t> group(column);
  for (std::size_t i = 0; i < column; ++i) group[i] = i;
  for (Eigen::Index i = 0; i < n; ++i) {
    const MeasuredPoint& p = of.points[static_cast<std::size_t>(i)];
    A(i, static_cast<Eigen::Index>(runs[p.run])) = 1;
    A(i, static_cast<Eigen::Index>(visits[{p.target, p.point.direction}])) = 1;
    for (Eigen::Index k = 0; k < 5; ++k)
      y(i, k) = of.errors[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  }
  for (std::size_t round = 0; round < column; ++round)
    for (const MeasuredPoint& p : of.points) {
      std::size_t &a = group[runs[p.run]], &b = group[visits[{p.target, p.point.direction}]];
      a = b = std::min(a, b);
    }
  const Eigen::MatrixXd solved = A.completeOrthogonalDecomposition().solve(y);
  std::vector<Errors5> drifts(runs.size());
  for (std::size_t run = 0; run < drifts.size(); ++run)
    for (std::size_t k = 0; k < 5; ++k) {
      double mean = 0, count = 0;
      for (std::size_t other = 0; other < drifts.size(); ++other) {
        if (group[other] != group[run]) continue;
        mean += solved(static_cast<Eigen::Index>(other), static_cast<Eigen::Index>(k));
        count += 1;
      }
      drifts[run][k] =
          solved(static_cast<Eigen::Index>(run), static_cast<Eigen::Index>(k)) - mean / count;
    }
  return drifts;
}

void expect_the_same(const Case& of) {
  const RunDrifts found(of.points);
  const auto drifts = found.of(of.errors), expected = fit_all_runs(of);
  ASSERT_EQ(drifts.size(), expected.size());
  for (std::size_t run = 0; run < drifts.size(); ++run)
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(drifts[run][k], expected[run][k], 1e-10);
}

// The cases have few runs with many visits, or many runs with few visits. A third of the visits is
// missing.
TEST(RunDrifts, MatchAFitOfAllRunsAndVisits) {
  std::mt19937 engine(7);
  for (int round = 0; round < 60; ++round) {
    const int runs = 1 + round % 7, targets = 1 + round % 5;
    Case of;
    for (int run = 0; run < runs; ++run)
      for (int target = 1; target <= targets; ++target)
        for (const int direction : {1, -1})
          if (engine() % 3 > 0) of.add(10 - 2 * run, target, direction, engine);
    if (of.points.empty()) continue;
    of.add(10, 1, -1, engine);  // a run may visit a target twice
    SCOPED_TRACE(round);
    expect_the_same(of);
  }
}

// No visit links the runs 1, 5 and 9 with the runs 2, 4 and 8, so each group has its own mean. One
// case has more visits than runs, the other fewer.
TEST(RunDrifts, UnlinkedRunsAreSeparate) {
  for (const int targets : {4, 1}) {
    std::mt19937 engine(3);
    Case of;
    for (int target = 1; target <= targets; ++target)
      for (const int run : {5, 2, 1, 4, 9, 8}) {
        const bool upper = run == 2 || run == 4 || run == 8;
        of.add(run, upper ? target + 10 : target, upper ? 1 : -1, engine);
      }
    expect_the_same(of);
    const RunDrifts found(of.points);
    const auto drifts = found.of(of.errors);  // drifts of the runs 1, 2, 4, 5, 8, 9
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(drifts[0][k] + drifts[3][k] + drifts[5][k], 0, 1e-12);
      EXPECT_NEAR(drifts[1][k] + drifts[2][k] + drifts[4][k], 0, 1e-12);
    }
    EXPECT_EQ(found.point_runs()[0], 3U);
    EXPECT_EQ(found.point_runs()[2], 0U);
    EXPECT_EQ(found.point_runs().size(), of.points.size());
  }
}

// Visits link each run only to the next one.
TEST(RunDrifts, AreCorrectForRunsLinkedByAChain) {
  std::mt19937 engine(5);
  Case of;
  for (int run = 1; run <= 6; ++run) {
    of.add(run, 7 - run, 1, engine);
    of.add(run, 8 - run, 1, engine);
  }
  expect_the_same(of);
}

}  // namespace
}  // namespace mdof::algo
