// If a log is cut, or if some targets have only one approach, backlash and drift must not change
// slope or squareness.
#include "algo/sequence/uneven_visits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "algo/compensation/compensation.h"
#include "algo/iso230/line_fit.h"
#include "algo/iso230/squareness.h"
#include "algo/iso230/straightness.h"
#include "algo/iso230/target_means.h"
#include "algo/uncertainty/budget/budget.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr double kBacklash_m = 1e-6, kDrift_m = 0.3e-6, kSlope = 20e-6, kStep_m = 5e-3;

// Increase of the reversal from target to target.
constexpr double kReversalIncrease_m = 0.2e-6;

struct Visit {
  int run, target, direction;
};
using Kept = std::function<bool(const Visit&)>;

// A run with thirteen targets in both directions. EYX is the sum of a slope, half of the backlash
// with the sign of the direction, a drift from run to run, and a bow of 4 um.
Run cut_run(int runs, const Kept& kept, Axis axis = Axis::x, double drift_m = kDrift_m) {
  Run run;
  run.header.axis = axis;
  run.header.state = RunState::complete;
  run.header.id = axis == Axis::x ? 1 : 2;
  for (int j = 1; j <= runs; ++j) {
    for (int i = 1; i <= 13; ++i) {
      for (const int direction : {1, -1}) {
        if (!kept({j, i, direction})) continue;
        MeasuredPoint p;
        p.target = i;
        p.run = j;
        p.point.direction = direction;
        p.point.position_m = p.target_m = kStep_m * (i - 7);
        const double bow = 4e-6 * (i - 7) * (i - 7) / 36.0;
        p.errors.valid = true;
        p.errors.local = local_from_named(
            axis, {kSlope * p.target_m + bow + 0.5 * direction * kBacklash_m + j * j * drift_m, 0,
                   0, 0, 0});
        p.errors.covariance[0] = 1e-18;
        run.points.push_back(p);
      }
    }
  }
  return run;
}

const Kept kAll = [](const Visit&) { return true; };

StraightnessFigure mean_figure(const mdof::Run& run) {
  for (const auto& figure : straightness({Axis::x, {}}, run.points))
    if (figure.approach == std::string("mean") && figure.error_key == std::string("EYX"))
      return figure;
  return {};
}

TEST(UnevenVisits, CompleteRunHasNoUnevenVisits) {
  for (const int runs : {1, 3}) {
    const mdof::Run run = cut_run(runs, kAll);
    EXPECT_EQ(subtract_run_drifts(run.points).points.size(), run.points.size());
    EXPECT_EQ(test::shown(uneven_visits(run.points)), "");
  }
  const mdof::Run one_way = cut_run(2, [](const Visit& v) { return v.direction > 0; });
  EXPECT_EQ(subtract_run_drifts(one_way.points).points.size(), 26);
  EXPECT_EQ(test::shown(uneven_visits(one_way.points)), "");
}

TEST(UnevenVisits, AreReported) {
  const auto found = [](int runs, const Kept& kept) {
    return test::shown(uneven_visits(cut_run(runs, kept).points));
  };
  EXPECT_EQ(found(1, [](const Visit& v) { return v.direction > 0 || v.target > 4; }),
            "target_from_one_side targets=targets 1 to 4\n");
  EXPECT_EQ(found(3, [](const Visit& v) { return v.run < 3 || v.target < 8; }),
            "run_lacks_visits runs=run 3\n");
  EXPECT_EQ(found(3,
                  [](const Visit& v) {
                    return v.run == 1 ? v.target != 13 || v.direction > 0 : v.target < 8;
                  }),
            "run_lacks_visits runs=runs 2, 3\ntarget_from_one_side targets=target 13\n");
  EXPECT_EQ(found(2, [](const Visit& v) { return v.run != v.target; }),
            "run_lacks_visits runs=runs 1, 2\n");
}

TEST(UnevenVisits, BacklashOfOneApproachDoesNotTiltTheMean) {
  const StraightnessFigure whole = mean_figure(cut_run(1, kAll));
  for (const int direction : {1, -1}) {
    for (const int from : {2, 5, 10, 13}) {
      const auto cut = mean_figure(
          cut_run(1, [&](const Visit& v) { return v.direction == direction || v.target >= from; }));
      EXPECT_NEAR(cut.slope_least_squares_rad, whole.slope_least_squares_rad, 1e-15) << from;
      EXPECT_NEAR(cut.straightness_least_squares_m, whole.straightness_least_squares_m, 1e-15)
          << from;
    }
  }
}

TEST(UnevenVisits, DriftOfAnIncompleteRunDoesNotTiltTheMean) {
  const mdof::Run y = cut_run(3, kAll, Axis::y);
  const Squareness whole = squareness(cut_run(3, kAll), y, {}).value();
  const std::vector<Kept> lacking = {
      [](const Visit& v) { return v.run < 3 || v.target == 1; },
      [](const Visit& v) { return v.run < 3 || (v.target < 8 && v.direction > 0); },
      [](const Visit& v) { return v.run < 2 || v.target < 12; },
      [](const Visit& v) { return v.target != (v.run < 3 ? 1 : 13); },  // no run is complete
  };
  for (std::size_t i = 0; i < lacking.size(); ++i) {
    const Squareness s = squareness(cut_run(3, lacking[i]), y, {}).value();
    EXPECT_NEAR(s.slope_a_rad, kSlope, 1e-14) << i;
    EXPECT_NEAR(s.error_rad, whole.error_rad, 1e-14) << i;
    // The drift shifts whole runs, which is included in the uncertainty. The form of the axis must
    // not increase the uncertainty.
    EXPECT_NEAR(s.u_slope_a_rad / whole.u_slope_a_rad, 1, 0.5) << i;
  }
}

TEST(UnevenVisits, DriftsOfTheRunsSumToZero) {
  const mdof::Run run = cut_run(3, [](const Visit& v) { return v.run != 3 || v.target != 9; });
  const auto without = subtract_run_drifts(run.points).points;
  const double drift_um[] = {0.3 - 1.4, 1.2 - 1.4, 2.7 - 1.4};
  for (std::size_t i = 0; i < without.size(); ++i)
    EXPECT_NEAR((run.points[i].errors.local[0] - without[i].errors.local[0]) * 1e6,
                drift_um[run.points[i].run - 1], 1e-9);
}

// The u of targets that only one run visited also includes the uncertainty of the level of the run.
TEST(UnevenVisits, UncertaintyOfEveryTargetContainsTheDrift) {
  const mdof::Run run = cut_run(2, [](const Visit& v) { return v.run < 2 || v.target < 10; });
  for (const auto approach : {Approach::forward, Approach::reverse, Approach::both})
    for (const TargetMean& mean : target_means({Axis::x, {}}, run.points, approach))
      EXPECT_NEAR(mean.u[0], 1.5 * kDrift_m, 1e-12)
          << to_string(approach);  // the mean of the levels 1 and 4 has u = s/√2
}

TEST(UnevenVisits, TableOfRunsWithOtherTargetsHasNoStep) {
  mdof::Run longer = cut_run(1, kAll, Axis::x, 0);
  mdof::Run shorter = cut_run(
      1, [](const Visit& v) { return v.target < 10; }, Axis::x, 10e-6);
  shorter.header.id = 2;
  const auto whole = build_table({longer}, {}).value();
  const auto table = build_table({longer, shorter}, {}).value();
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_NEAR(table.forward[0][i] - table.forward[0][0],
                whole.forward[0][i] - whole.forward[0][0], 1e-15);
    // The levels of the runs cancel. The noise of 1 nm remains.
    EXPECT_LE(table.u_forward[0][i], 2e-9);
    EXPECT_GT(table.u_forward[0][i], 0.3e-9);
  }
  EXPECT_EQ(test::shown(uneven_visit_notices({longer, longer}).value()), "");
  EXPECT_EQ(test::shown(uneven_visit_notices({longer, shorter}).value()),
            "all runs together (the repetitions of all runs are numbered in one sequence): "
            "run_lacks_visits "
            "runs=run 2\n");
}

TEST(UnevenVisits, ReportsIfNoTargetHasBothApproaches) {
  const mdof::Run run =
      cut_run(1, [](const Visit& v) { return (v.direction > 0) == (v.target < 6); });
  EXPECT_EQ(test::shown(uneven_visits(run.points)), "approaches_mixed\n");
}

// The least-squares solution without equations: the means of the runs and of the visits are
// calculated in turn until they converge. `group`: group of a run; runs of different groups share
// no visit.
std::map<int, double> alternating_drifts(const std::vector<MeasuredPoint>& points,
                                         const std::function<int(int)>& group) {
  std::map<int, double> of_run;
  std::map<std::pair<int, int>, double> of_visit;
  const auto visit = [](const MeasuredPoint& p) { return std::pair(p.target, p.point.direction); };
  for (int turn = 0; turn < 3000; ++turn) {
    std::map<int, std::pair<double, int>> runs;
    std::map<std::pair<int, int>, std::pair<double, int>> visits;
    for (const auto& p : points) {
      auto& [sum, n] = runs[p.run];
      sum += p.errors.local[0] - of_visit[visit(p)];
      ++n;
    }
    for (const auto& [run, sum] : runs) of_run[run] = sum.first / sum.second;
    for (const auto& p : points) {
      auto& [sum, n] = visits[visit(p)];
      sum += p.errors.local[0] - of_run[p.run];
      ++n;
    }
    for (const auto& [v, sum] : visits) of_visit[v] = sum.first / sum.second;
  }
  std::map<int, std::pair<double, int>> groups;
  for (const auto& [run, drift] : of_run) {
    groups[group(run)].first += drift;
    ++groups[group(run)].second;
  }
  for (auto& [run, drift] : of_run) drift -= groups[group(run)].first / groups[group(run)].second;
  return of_run;
}

// Few runs with many targets and many runs with few targets are solved by different methods. The
// runs form two groups that share no visit.
TEST(UnevenVisits, DriftsMatchLeastSquares) {
  const auto group = [](int run) { return run % 2; };
  std::mt19937_64 engine(11);
  std::normal_distribution<> unit;
  std::bernoulli_distribution is_there(0.7);
  const auto kept = [&](const Visit& v) {
    return (v.target <= 6) == (group(v.run) == 0) && is_there(engine);
  };
  for (const int runs : {6, 60}) {
    auto points = cut_run(runs, kept, Axis::x, 0).points;
    for (auto& p : points) p.errors.local[0] += 1e-6 * unit(engine);
    const auto truth = alternating_drifts(points, group);
    const auto without = subtract_run_drifts(points).points;
    ASSERT_EQ(without.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(points[i].errors.local[0] - without[i].errors.local[0], truth.at(points[i].run),
                  1e-15)
          << runs << " runs, run " << points[i].run;
  }
}

// Runs without a common visit cannot be compared, so no drift is subtracted.
TEST(UnevenVisits, RunsWithoutACommonVisitAreUnchanged) {
  const mdof::Run run = cut_run(2, [](const Visit& v) { return (v.run == 1) == (v.target < 7); });
  const auto same = subtract_run_drifts(run.points).points;
  for (std::size_t i = 0; i < same.size(); ++i)
    EXPECT_NEAR(same[i].errors.local[0], run.points[i].errors.local[0], 1e-18);
}

// Three neighbouring targets are too few for a slope, because the slope would follow their noise.
TEST(UnevenVisits, RunOfThreeTargetsKeepsTheSlopeUncertainty) {
  std::mt19937_64 engine(4);
  std::normal_distribution<> unit;
  const mdof::Run y = cut_run(1, kAll, Axis::y);
  double with = 0, without = 0;
  for (int trial = 0; trial < 100; ++trial) {
    mdof::Run x = cut_run(
        4, [](const Visit& v) { return v.run < 4 || v.target < 4; }, Axis::x, 0);
    for (MeasuredPoint& p : x.points) p.errors.local[0] += 10e-9 * unit(engine);
    with += squareness(x, y, {}).value().u_slope_a_rad;
    std::erase_if(x.points, [](const MeasuredPoint& p) { return p.run == 4; });
    without += squareness(x, y, {}).value().u_slope_a_rad;
  }
  EXPECT_NEAR(with / without, 1, 0.1);
}

TEST(UnevenVisits, TableRemovesTheSlopeOfTheWholeAxis) {
  const auto of = [](const Kept& kept) { return build_table({cut_run(1, kept)}, {}).value(); };
  const auto whole = of(kAll);
  const auto cut = of([](const Visit& v) { return v.direction > 0 || v.target > 4; });
  ASSERT_EQ(cut.position_m, whole.position_m);
  EXPECT_TRUE(std::isnan(cut.reverse[0][3]));
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_NEAR(cut.forward[0][i], whole.forward[0][i], 1e-15);
    if (i > 3) {
      EXPECT_NEAR(cut.reverse[0][i], whole.reverse[0][i], 1e-15);
    }
  }
}

// Targets 8 to 13 have one approach. The reversal of a target is kReversalIncrease_m times its
// number. Calculated by hand: the mean reversal of the other targets is the reversal of target 4,
// so the mean of target i is wrong by (i - 4)/2 kReversalIncrease_m. The slope over the 13 targets
// is wrong by sum((i
// - 7)(i - 4)) / 2 / 182 = 77/182 of kReversalIncrease_m per target.
TEST(UnevenVisits, UncertaintyCoversAGrowingReversal) {
  for (const int only : {1, -1}) {
    mdof::Run x = cut_run(1, [&](const Visit& v) { return v.direction == only || v.target < 8; });
    for (MeasuredPoint& p : x.points)
      p.errors.local[0] += 0.5 * p.point.direction * p.target * kReversalIncrease_m;
    const auto means = target_means({Axis::x, {}}, x.points, Approach::both);
    for (const TargetMean& mean : means) {
      const double off_m =
          mean.target < 8 ? 0 : 0.5 * only * (mean.target - 4) * kReversalIncrease_m;
      EXPECT_NEAR(mean.u_trend[0], off_m, 1e-12) << mean.target;
      EXPECT_GE(mean.u[0], std::abs(off_m)) << mean.target;
    }
    const double off_rad = 77.0 / 182 * kReversalIncrease_m / kStep_m;
    const double slope_rad = least_squares_line(own_travels({}, means), column(means, 0)).slope;
    EXPECT_NEAR(slope_rad, kSlope + only * off_rad, 1e-9);
    const Squareness s = squareness(x, cut_run(1, kAll, Axis::y), {}).value();
    EXPECT_GE(s.u_slope_a_rad, off_rad);
    EXPECT_LE(s.u_slope_a_rad, 1.1 * off_rad);
    const Budget budget = RunBudgets({}, x).of(slope_figure(Axis::x, 0));
    EXPECT_GE(budget.u, off_rad);
    EXPECT_LE(budget.u, 1.1 * off_rad);
  }
}

// Half of the targets lack an approach, and the reversal differs from target to target. Compared:
// the stated u of the slope and the rms of its error. In one of ten trials, the scatter of the
// reversal looks like a trend; the trend is then added to u, and the mean square of u is too large.
// The other trials must be correct.
TEST(UnevenVisits, UncertaintyCoversAScatteringReversal) {
  std::mt19937_64 engine(3);
  std::normal_distribution<> unit;
  double square = 0, stated = 0;
  constexpr int kTrials = 2000;
  const mdof::Run y = cut_run(1, kAll, Axis::y);
  for (int trial = 0; trial < kTrials; ++trial) {
    mdof::Run x = cut_run(1, [](const Visit& v) { return v.direction > 0 || v.target > 6; });
    std::map<int, double> reversal_m;
    for (MeasuredPoint& p : x.points) {
      const auto [at, first] = reversal_m.try_emplace(p.target, 0.0);
      if (first) at->second = 0.2e-6 * unit(engine);
      p.errors.local[0] += 0.5 * p.point.direction * at->second + 1e-9 * unit(engine);
    }
    const Squareness s = squareness(x, y, {}).value();
    square += (s.slope_a_rad - kSlope) * (s.slope_a_rad - kSlope);
    stated += s.u_slope_a_rad * s.u_slope_a_rad;
  }
  EXPECT_GT(std::sqrt(stated / square), 0.9);
  EXPECT_LT(std::sqrt(stated / square), 1.8);
}

}  // namespace
}  // namespace mdof::algo
