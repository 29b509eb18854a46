// Random noise is added to each reading. The tests count how often the stated intervals contain the
// true values of a straight or curved axis. They also check that a drift of the level has no effect
// on figures in which it cancels. Set MDOF_COVERAGE_RUNS=1000 to calculate figures for publication.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>

#include "algo/compensation/compensation.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/statistics/range_interval.h"
#include "algo/uncertainty/statistics/run_shifts.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

constexpr double kNoise_m = 40e-9;

struct Held {
  int inside = 0, all = 0;
  double percent() const { return 100.0 * inside / all; }
};

int wanted() {
  return test::coverage_runs(150);
}

Errors5 bend(double d, double height_m, double angle_rad) {
  const double s = std::sin(2 * M_PI * d / 0.040), c = std::cos(2 * M_PI * d / 0.040);
  return {height_m * s, height_m * c, angle_rad * s, angle_rad * c, angle_rad * s};
}

// For each figure, by its name: the number of intervals that contain the value of the same axis
// without noise.
std::map<std::string, Held> held(int runs, double height_m, double angle_rad) {
  const Rig rig = test::rig_x_with("", "");
  std::mt19937_64 engine(test::coverage_seed(99));
  std::normal_distribution<> normal(0, kNoise_m);
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = runs};
  synthetic.truth = [&](double d) { return bend(d, height_m, angle_rad); };
  const RunBudgets exact(rig, synthetic.measure());
  synthetic.u_reading_m = kNoise_m;
  synthetic.added = [&](std::size_t, double, double, double) { return normal(engine); };
  std::map<std::string, Held> all;
  const std::vector<Figure> figures = figures_of_run(Axis::x);
  for (int i = 0; i < wanted(); ++i) {
    const auto budgets = RunBudgets(rig, synthetic.measure()).of(figures);
    for (std::size_t f = 0; f < figures.size(); ++f) {
      Held& of = all[figures[f].name];
      ++of.all;
      of.inside += std::abs(budgets[f].value - figures[f].of(exact.means())) <= budgets[f].U;
    }
  }
  return all;
}

void expect_coverage(const std::map<std::string, Held>& all) {
  const double three_sd = 65 / std::sqrt(wanted());
  for (const auto& [figure, of] : all) {
    std::printf("%-22s %5.1f %%\n", figure.c_str(), of.percent());
    EXPECT_GT(of.percent(), 95 - three_sd) << figure;
  }
}

TEST(NoiseOfRuns, APerfectAxisMayBePerfect) {
  for (const int runs : {1, 3}) {
    SCOPED_TRACE(runs);
    expect_coverage(held(runs, 0, 0));
  }
}

// The straightness of the axis is 100 nm or 2 µm. The noise at a target is 28 nm for one run and 16
// nm for three runs.
TEST(NoiseOfRuns, IntervalsCoverABentAxis) {
  for (const int runs : {1, 3})
    for (const double height_m : {50e-9, 1e-6}) {
      SCOPED_TRACE(runs);
      expect_coverage(held(runs, height_m, 100 * height_m));
    }
}

// All readings are equal, as with a coarse converter, so the measured range is 0. The noise that
// the converter hides has the studentized range of nine normal numbers; its 95 % point is 4.387
// (Harter, 1960).
TEST(NoiseOfRuns, EqualDeviationsKeepAnUncertainty) {
  const Rig rig = test::rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  synthetic.u_reading_m = kNoise_m;
  const RunBudgets budgets(rig, synthetic.measure());
  const double mean_u_rad = kNoise_m * std::sqrt(2.0) / 10e-3 / std::sqrt(6.0);
  const Budget yaw = budgets.of(range_figure(Axis::x, 4));
  EXPECT_EQ(yaw.value, 0);
  EXPECT_NEAR(yaw.U / mean_u_rad, 4.387, 0.1);
  // The mean square of the range of nine normal numbers is 2.970² + 0.808² (Tippett).
  EXPECT_NEAR(yaw.u / mean_u_rad, std::hypot(2.970, 0.808), 0.06);
  EXPECT_NEAR(yaw.coverage_factor, yaw.U / yaw.u, 1e-12);
  synthetic.u_reading_m = 0;  // no noise, and the rig declares no uncertainties
  EXPECT_TRUE(std::isnan(RunBudgets(rig, synthetic.measure()).of(range_figure(Axis::x, 4)).U));
}

// The interval of a range must not be too wide. For a form far above the noise it is ±1.96 √2 u.
TEST(NoiseOfRuns, LargeRangeHasTheUncertaintyOfItsEnds) {
  std::mt19937_64 engine(3);
  std::normal_distribution<> normal;
  std::vector<double> changes;
  for (int i = 0; i < 3 * 20000; ++i) changes.push_back(normal(engine));
  EXPECT_NEAR(RangeTrials({0, 50, 100}, changes).U(), 1.96 * std::sqrt(2.0), 0.05);
  // All values are 0, so the range is that of three normal numbers; its 95 % point is 3.31
  // (studentized range).
  EXPECT_NEAR(RangeTrials({0, 0, 0}, changes).U(), 3.31, 0.05);
  EXPECT_NEAR(RangeTrials({0, 1, 3}, changes).U(), 3.31, 0.05);  // the interval contains 0
}

// Only the highest point has an error; it is 2.2 above the next point. If the trials started from
// this point lowered by U/2, the next point would be almost as high, and 95 % of the trials would
// be within 1.64.
TEST(NoiseOfRuns, UIsAtLeastThatOfTheMeasuredRange) {
  std::mt19937_64 engine(4);
  std::normal_distribution<> normal;
  std::vector<double> changes(3 * 20000);
  for (std::size_t i = 2; i < changes.size(); i += 3) changes[i] = normal(engine);
  EXPECT_NEAR(RangeTrials({0, 97.8, 100}, changes).U(), 1.96, 0.04);
}

// Only the highest point has an error; on the true axis it is 2 above the next point. If the
// measured point is almost as low as the next point, the trials can only raise the range, and 95 %
// of them are within 1.64.
TEST(NoiseOfRuns, SecondHighPointDoesNotNarrowARange) {
  std::mt19937_64 engine(8);
  std::normal_distribution<> normal;
  std::vector<double> changes(3 * 4000);
  for (std::size_t i = 2; i < changes.size(); i += 3) changes[i] = normal(engine);
  Held held;
  for (int i = 0; i < 4000; ++i) {
    const std::vector<double> measured = {0, 98, 100 + normal(engine)};
    const double range = std::max(measured[1], measured[2]);
    ++held.all;
    held.inside += std::abs(range - 100) <= RangeTrials(measured, changes).U();
  }
  std::printf("a second point nearly as high: %.1f %%\n", held.percent());
  EXPECT_NEAR(held.percent(), 95, 1.2);
}

// The levels of probes D and E change together by 200 nm from pass to pass. The slope does not
// change.
TEST(NoiseOfRuns, UOfASlopeOmitsADriftOfTheLevel) {
  const Rig rig = test::rig_x_with("", "");
  std::mt19937_64 engine(5);
  std::normal_distribution<> normal;
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  constexpr double kLevel_m = 200e-9, kWhite_m = 1e-9;
  synthetic.u_reading_m = kWhite_m;
  const Figure slope = slope_figure(Axis::x, 0), error = error_figure(Axis::x, 0, 5);
  double square = 0, U_sum = 0, error_square = 0, u_error_square = 0;
  constexpr int kRuns = 200;
  for (int i = 0; i < kRuns; ++i) {
    std::map<int, double> level;  // level of each pass of nine points, one every ten seconds
    for (int pass = 0; pass < 6; ++pass) level[pass] = kLevel_m * normal(engine);
    synthetic.added = [&](std::size_t k, double, double, double time_s) {
      const int pass = static_cast<int>((time_s - 5) / 90);
      return kWhite_m * normal(engine) + (k == 3 || k == 4 ? level[pass] : 0.0);
    };
    const RunBudgets budgets(rig, synthetic.measure());
    const Budget of_slope = budgets.of(slope), of_error = budgets.of(error);
    square += of_slope.value * of_slope.value / kRuns;
    U_sum += of_slope.U / kRuns;
    error_square += of_error.value * of_error.value / kRuns;
    u_error_square += of_error.u * of_error.u / kRuns;
  }
  const double spread = 1.96 * std::sqrt(square);
  std::printf("U of the slope / true spread: %.3f\n", U_sum / spread);
  EXPECT_LT(U_sum / spread, 1.3);
  EXPECT_GT(U_sum / spread, 0.85);
  // The level contributes to the error at a target.
  EXPECT_NEAR(std::sqrt(u_error_square / error_square), 1, 0.2);
}

// Root mean square of u over the root mean square of the error.
struct UncertaintyRatio {
  double square = 0, u_square = 0;
  void add(double error, double u) { square += error * error, u_square += u * u; }
  double ratio() const { return std::sqrt(u_square / square); }
};

// The axis is straight. Run 2 ends at target 6 of the reverse pass, run 3 at target 3 of the
// forward pass. The levels of probes D and E change together from pass to pass or from run to run.
std::map<std::string, UncertaintyRatio> incomplete_run_u_ratios(double level_m, bool of_each_pass) {
  const Rig rig = test::rig_x_with("", "");
  std::mt19937_64 engine(test::coverage_seed(6));
  std::normal_distribution<> normal;
  constexpr double kWhite_m = 10e-9;
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  synthetic.u_reading_m = kWhite_m;
  std::map<std::string, UncertaintyRatio> all;
  for (int i = 0; i < test::coverage_runs(400); ++i) {
    std::array<double, 6> level{};
    for (std::size_t pass = 0; pass < level.size(); ++pass)
      level[pass] = pass % 2 == 0 || of_each_pass ? level_m * normal(engine) : level[pass - 1];
    synthetic.added = [&](std::size_t k, double, double, double time_s) {
      const auto pass = static_cast<std::size_t>((time_s - 5) / 90);
      return kWhite_m * normal(engine) + (k == 3 || k == 4 ? level[pass] : 0.0);
    };
    Run run = synthetic.measure();
    std::erase_if(run.points, [](const MeasuredPoint& p) {
      const bool forward = p.point.direction > 0;
      return (p.run == 2 && !forward && p.target < 6) || (p.run == 3 && (!forward || p.target > 3));
    });
    const RunBudgets budgets(rig, run);
    for (const std::size_t k : {0u, 4u}) {
      const Figure error = error_figure(Axis::x, k, 8);
      const Budget of_error = budgets.first_order(error);
      all["error " + error.name].add(of_error.value, of_error.u);
    }
    const Budget slope = budgets.first_order(slope_figure(Axis::x, 0));
    all["slope"].add(slope.value, slope.u);
    for (const bool remove_slope : {true, false}) {
      TableOptions options;
      options.stated = kAtFixture;
      options.remove_slope = remove_slope;
      const CompensationTable table = build_table({run}, options).value();
      const std::string name = remove_slope ? "table " : "table with slope ";
      for (std::size_t t = 0; t < 9; ++t) {
        all[name + "forward"].add(table.forward[0][t], table.u_forward[0][t]);
        all[name + "reverse"].add(table.reverse[0][t], table.u_reverse[0][t]);
      }
    }
  }
  for (const auto& [name, of] : all)
    std::printf("level %3.0f nm, %-24s u / spread %.3f\n", level_m * 1e9, name.c_str(), of.ratio());
  return all;
}

// A common level of all targets of a run cancels, even if the run lacks visits.
TEST(NoiseOfRuns, OfRunsThatLackVisitsALevelCancelsAsOfWholeOnes) {
  for (const double level_m : {0.0, 200e-9})
    for (const auto& [name, of] : incomplete_run_u_ratios(level_m, false)) {
      // Three runs determine the level itself with two degrees of freedom only.
      const bool has_level = name == "error EYX_um" || name.starts_with("table with slope");
      EXPECT_GT(of.ratio(), 0.95) << name << " " << level_m;
      EXPECT_LT(of.ratio(), has_level ? 1.5 : 1.25) << name << " " << level_m;
    }
}

// A separate level of each pass does not cancel if a run lacks a part of a pass.
TEST(NoiseOfRuns, OfRunsThatLackVisitsALevelOfEachPassStays) {
  for (const auto& [name, of] : incomplete_run_u_ratios(200e-9, true)) {
    EXPECT_GT(of.ratio(), 0.9) << name;
    EXPECT_LT(of.ratio(), 1.35) << name;
  }
}

// Plain loops calculate the trials of a range. Compared: the standard deviation of the trials, and
// the root mean square of their distances from the measured range.
TEST(RangeTrials, MatchManualCalculation) {
  const std::vector<double> measured = {3, -1, 4, 0},
                            changes = {1, 0, 0, 0, 0, 2, 0, -3, -5, 1, 0, 0};
  const RangeTrials trials(measured, changes);
  // Ranges: {4, -1, 4, 0}: 5; {3, 1, 4, -3}: 7; {-2, 0, 4, 0}: 6.
  EXPECT_NEAR(trials.standard_deviation(), 1, 1e-15);
  EXPECT_NEAR(trials.root_mean_square(5), std::sqrt((0 + 4 + 1) / 3.0), 1e-15);
}

// Points of three runs. Different visits are missing in each run; all errors are 0.
std::vector<MeasuredPoint> incomplete_runs_points() {
  std::vector<MeasuredPoint> points;
  for (int run = 1; run <= 3; ++run)
    for (const int direction : {1, -1})
      for (int target = 1; target <= 5; ++target) {
        if (run == 2 && target > 3) continue;
        if (run == 3 && (target < 3 || (target == 4 && direction < 0))) continue;
        MeasuredPoint p;
        p.run = run;
        p.target = target;
        p.point.direction = direction;
        p.errors.valid = true;
        points.push_back(p);
      }
  return points;
}

std::map<TargetAndApproach, double> means_without_drift(const std::vector<MeasuredPoint>& points) {
  std::map<TargetAndApproach, double> sum, n;
  for (const MeasuredPoint& p : subtract_run_drifts(points).points) {
    const TargetAndApproach at{p.target, p.point.direction > 0 ? 1 : 0};
    sum[at] += p.errors.local[0];
    n[at] += 1;
  }
  for (auto& [at, s] : sum) s /= n[at];
  return sum;
}

// The means are linear in the readings. Each reading in turn is increased by 1; the changes of the
// means give the covariances of the means.
TEST(RunShifts, PartsGiveTheCovarianceOfTheMeans) {
  const std::vector<MeasuredPoint> points = incomplete_runs_points();
  std::map<std::pair<TargetAndApproach, TargetAndApproach>, double> covariance;
  std::map<TargetAndApproach, double> visits;
  for (std::size_t j = 0; j < points.size(); ++j) {
    std::vector<MeasuredPoint> moved = points;
    moved[j].errors.local[0] = 1;
    const auto means = means_without_drift(moved);
    for (const auto& [a, x] : means)
      for (const auto& [b, y] : means) covariance[{a, b}] += x * y;
    visits[{points[j].target, points[j].point.direction > 0 ? 1 : 0}] += 1;
  }
  const auto parts = parts_by_run_shifts(points);
  EXPECT_EQ(parts.size(), 2u);  // three runs relative to each other: two degrees of freedom
  for (const auto& [at, expected] : covariance) {
    double found = at.first == at.second ? 1 / visits[at.first] : 0;
    for (const auto& part : parts) found += part.at(at.first) * part.at(at.second);
    EXPECT_NEAR(found, expected, 1e-12);
  }
  std::vector<MeasuredPoint> whole = points;
  std::erase_if(whole, [](const MeasuredPoint& p) { return p.run != 1; });
  EXPECT_TRUE(parts_by_run_shifts(whole).empty());
}

// Change of the means if a forward pass is higher by 1 and the reverse pass of the same run lower
// by 1. The half differences of the passes of the three runs are 2, 0.5 and -3.5; their variance is
// 97/12.
TEST(RunShifts, LevelsOfPassesShiftTheMeans) {
  const std::vector<MeasuredPoint> points = incomplete_runs_points();
  std::vector<MeasuredPoint> measured = points;
  const double level[3][2] = {{-1, 3}, {4, 5}, {2, -5}};
  for (MeasuredPoint& p : measured)
    p.errors.local[0] = 0.1 * p.target * p.target + 0.2 * p.point.direction * p.target +
                        level[p.run - 1][p.point.direction > 0 ? 1 : 0];
  const PassLevels levels = pass_levels({}, measured, {});
  EXPECT_EQ(levels.freedom, 2);
  EXPECT_NEAR(levels.u_half[0], std::sqrt(97.0 / 12), 1e-12);
  ASSERT_EQ(levels.parts.size(), 3u);
  for (int run = 1; run <= 3; ++run) {
    std::vector<MeasuredPoint> moved = points;
    for (MeasuredPoint& p : moved)
      if (p.run == run) p.errors.local[0] = p.point.direction;
    for (const auto& [at, change] : means_without_drift(moved))
      EXPECT_NEAR(levels.parts[static_cast<std::size_t>(run) - 1].at(at), change, 1e-12);
  }
  // The noise u = 2 of the visits contributes to the three half differences 4 times (1/5 + 1/5)/4,
  // 4 times (1/3 + 1/3)/4 and 4 times (1/3 + 1/2)/4. The mean of the three contributions is
  // subtracted.
  EXPECT_NEAR(pass_levels({}, measured, {2}).u_half[0],
              std::sqrt(97.0 / 12 - (0.4 + 2.0 / 3 + 5.0 / 6) / 3), 1e-12);
  std::erase_if(measured, [](const MeasuredPoint& p) { return p.run != 1; });
  EXPECT_TRUE(pass_levels({}, measured, {}).parts.empty());
}

}  // namespace
}  // namespace mdof::algo
