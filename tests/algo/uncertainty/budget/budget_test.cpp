#include "algo/uncertainty/budget/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "algo/uncertainty/budget/two_runs.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using test::rig_x_with;

constexpr double kFixture_m = 0.010;  // l of the default fixture

Budget budget(const RunBudgets& budgets, const std::string& figure) {
  for (const Figure& f : figures_of_run(Axis::x))
    if (f.name == figure) return budgets.of(f);
  ADD_FAILURE() << figure;
  return {};
}

double contribution(const Budget& b, const std::string& name) {
  for (const BudgetLine& line : b.lines)
    if (contributor_text(line.name) == name) return line.contribution;
  ADD_FAILURE() << name;
  return 0;
}

// A common offset cancels in straightness, slope and range, but not in the error at a target.
TEST(Budget, CommonOffsetCancelsInDifferences) {
  const Rig rig = rig_x_with("D", "u_calibration_um = 0.1");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{1e-6 * std::sin(200 * d), 0, 0, 0, 0}; };
  const auto budgets = RunBudgets::create(rig, synthetic.measure()).value();
  for (const char* figure :
       {"EYX_straightness_um", "EYX_slope_urad", "ECX_range_urad", "EZX_straightness_um"})
    EXPECT_NEAR(budget(budgets, figure).u, 0, 1e-13) << figure;
  const Budget at = budgets.of(error_figure(Axis::x, 0, 5));
  EXPECT_EQ(at.figure, "EYX_um");
  EXPECT_NEAR(at.u, 0.1e-6, 1e-12);
  EXPECT_NEAR(at.U, 0.1959964e-6, 1e-12);
  EXPECT_NEAR(at.lines[0].share, 1, 1e-12);
  EXPECT_NEAR(budgets.of(error_figure(Axis::x, 4, 5)).u, 0.1e-6 / kFixture_m, 1e-9);
}

// One direction with a point every 10 s and 5 mm. A drift of D by 1 nm/s is 10 nm in 5 mm, which is
// a slope of 2 µrad. With both directions the drift cancels in the slope almost completely.
TEST(Budget, DriftIsASlopeInOneDirection) {
  const Rig rig = rig_x_with("", "", "[drift]\nu_um_per_h = 3.6\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .runs = 1};
  auto run = synthetic.measure();
  const double both = contribution(budget(RunBudgets::create(rig, run).value(), "EYX_slope_urad"),
                                   "probe D: drift");
  EXPECT_NEAR(both, 0, 1e-10);
  run.points.resize(9);
  const Budget slope = budget(RunBudgets::create(rig, run).value(), "EYX_slope_urad");
  EXPECT_NEAR(contribution(slope, "probe D: drift"), 2e-6, 1e-10);
  EXPECT_NEAR(contribution(slope, "probe E: drift"), 0, 1e-10);
}

// Calculated by hand: if all means have the same u, the slope has the uncertainty u/√Sxx.
TEST(Budget, NoiseOfIndependentTargetsIsCorrect) {
  const Rig rig = rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .runs = 1};
  synthetic.u_reading_m = 10e-9;
  const auto run = synthetic.measure();
  const Budget slope = budget(RunBudgets::create(rig, run).value(), "EYX_slope_urad");
  EXPECT_TRUE(slope.noise_only);
  ASSERT_EQ(slope.lines.size(), 1u);
  // EYX = D + (B - C) l''/2l with l''/2l = 1, so the noise u of D, B and C contributes once each.
  const double u_mean = 10e-9 * std::sqrt(3.0) / std::sqrt(2.0);  // mean of both approaches
  const double sxx = 25e-6 * 60;                                  // Σ (i - 4)² = 60
  EXPECT_NEAR(slope.u, u_mean / std::sqrt(sxx), 1e-12);
  EXPECT_EQ(slope.u, slope.u_random);
  // Without repeated visits, noise with periods longer than a stop is unknown. The text states
  // this.
  EXPECT_NE(
      covers_text(slope).find("noise with periods longer than a stop is not included (in at least "
                              "one run, no target was approached twice from the same direction)"),
      std::string::npos);
  synthetic.runs = 3;
  EXPECT_EQ(
      covers_text(budget(RunBudgets::create(rig, synthetic.measure()).value(), "EYX_slope_urad")),
      "noise and repeatability only (no uncertainties are declared)");
}

// The scatter of the slopes of whole runs is not visible in the scatter at single targets.
TEST(Budget, DifferentTiltsOfRunsScatterTheSlope) {
  const Rig rig = rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 5};
  const double tilt[] = {1e-6, -2e-6, 3e-6, 0, -2e-6};  // sd 2.1213 urad, mean 0
  synthetic.added = [&](std::size_t k, double d, double, double time_s) {
    const auto run = static_cast<std::size_t>((time_s - 5) / 180);
    return k == 3 || k == 4 ? tilt[run] * d : 0.0;
  };
  const Budget slope =
      budget(RunBudgets::create(rig, synthetic.measure()).value(), "EYX_slope_urad");
  EXPECT_NEAR(slope.u, std::sqrt((1 + 4 + 9 + 4) / 4.0 / 5) * 1e-6, 1e-10);
  EXPECT_NEAR(slope.freedom, 4, 0.6);  // single targets show little of this scatter
  EXPECT_NEAR(slope.coverage_factor, 2.7, 0.1);
}

TEST(Budget, LinesAreSortedAndSharesAddToOne) {
  const Rig rig =
      rig_x_with("D", "u_calibration_um = 0.03\nu_sensitivity_ppm = 2000\nu_direction_mrad = 3",
                 "[installation]\nu_angle_mrad = [2, 2, 2]\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{2e-4 * d, 1e-4 * d, 1e-3 * d, 0, 2e-3 * d}; };
  synthetic.u_reading_m = 5e-9;
  const auto budgets = RunBudgets::create(rig, synthetic.measure()).value();
  const Budget at = budgets.of(error_figure(Axis::x, 0, 9));
  double shares = 0;
  for (std::size_t i = 0; i < at.lines.size(); ++i) {
    shares += at.lines[i].share;
    EXPECT_LE(at.lines[i].share, at.lines[i > 0 ? i - 1 : 0].share);
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_FALSE(at.noise_only);
  // The first-order u equals the Monte Carlo u for a nearly linear model.
  const BudgetTrials trials = summary_of(
      budgets.draw({error_figure(Axis::x, 0, 9)}, {.trials = 20000, .seed = 3}).front(), 3);
  EXPECT_NEAR(trials.u / at.u, 1, 0.02);
  EXPECT_NEAR((trials.high - trials.low) / 2 / at.U, 1, 0.03);
}

// The trials of a rectangular quantity with u = 1 µm: their 95 % interval ends at 0.95 · √3 µm, not
// at 1.96 u.
TEST(Budget, TrialsHaveTheDeclaredDistributions) {
  const std::string flat = "u_calibration_um = { u = 1, distribution = \"rectangular\" }";
  const Rig one = rig_x_with("D", flat);
  const auto of_one = RunBudgets::create(one, SyntheticRun{.rig = one}.measure()).value();
  const Figure error = error_figure(Axis::x, 0, 1);
  const BudgetTrials trials =
      summary_of(of_one.draw({error}, {.trials = 50000, .seed = 1}).front(), 1);
  EXPECT_NEAR(trials.u, 1e-6, 0.01e-6);
  EXPECT_NEAR(trials.high, 0.95 * std::sqrt(3.0) * 1e-6, 0.01e-6);
}

// The default fixture for Y, with local x = +Y and local y = -X.
Rig rig_y(const std::string& of_D = "") {
  std::string toml = test::rig_x_toml();
  const auto at = [&](const char* from, const std::string& to) {
    toml.replace(toml.find(from), std::string(from).size(), to);
  };
  at("\"X\"", "\"Y\"");
  at("position_mm = [10.000000, 0.000000, 0.000000]", "position_mm = [0, 10, 0]");
  at("position_mm = [0.000000, 10.000000, 0.000000]", "position_mm = [-10, 0, 0]");
  at("position_mm = [0.000000, -10.000000, 0.000000]", "position_mm = [10, 0, 0]");
  at("position_mm = [0.000000, 15.000000, 20.000000]", of_D + "position_mm = [-15, 0, 20]");
  at("position_mm = [10.000000, 15.000000, 20.000000]", "position_mm = [-15, 10, 20]");
  for (int i = 0; i < 2; ++i) at("measures = \"+Y\"", "measures = \"-X\"");
  return parse_rig(toml, "rig_Y.toml").value();
}

TEST(Budget, SquarenessUsesBothRunsAndTheSquare) {
  const Rig x = rig_x_with("", "", "[drift]\nu_um_per_h = 3.6\n"), y = rig_y();
  SyntheticRun along_x{.rig = x, .runs = 1}, along_y{.rig = y, .runs = 3};
  along_x.truth = [](double d) { return Errors5{3e-6 * d, 0, 0, 0, 0}; };
  along_y.truth = [](double d) { return Errors5{-5e-6 * d, 0, 0, 0, 0}; };
  auto one_way = along_x.measure();
  one_way.points.resize(9);
  const SquareArtefact square{.angle_error_rad = 2e-6, .u_rad = 0.4e-6, .corner = -1};
  const Budget b =
      squareness_budget(x, one_way, y, along_y.measure(), square, {.trials = 20000}).value();
  // EXY = -δy of the Y axis, which has the slope +5 µrad. EC0Y = (-5 - 3 - 2) µrad.
  EXPECT_NEAR(b.value, -10e-6, 1e-10);
  EXPECT_NEAR(contribution(b, "X, probe D: drift"), -2e-6, 1e-10);
  EXPECT_NEAR(contribution(b, "angle of the square"), -0.4e-6, 1e-15);
  EXPECT_FALSE(b.noise_only);
  ASSERT_TRUE(b.trials);
  EXPECT_NEAR(b.trials->u / b.u, 1, 0.02);
  EXPECT_NEAR((b.trials->low + b.trials->high) / 2, b.value, 0.1e-6);
}

TEST(Budget, SquarenessAndSlopesEqualSeparateBudgets) {
  const Rig x = rig_x_with("", "", "[drift]\nu_um_per_h = 3.6\n"), y = rig_y();
  SyntheticRun along_x{.rig = x, .runs = 1}, along_y{.rig = y, .runs = 3};
  along_x.truth = [](double d) { return Errors5{3e-6 * d, 0, 0, 0, 0}; };
  auto run_x = along_x.measure();
  run_x.points.resize(9);
  const auto run_y = along_y.measure();
  const SquareArtefact square{.angle_error_rad = 2e-6, .u_rad = 0.4e-6, .corner = -1};
  const auto all = squareness_and_slope_budgets(x, run_x, y, run_y, square).value();
  const Budget alone = squareness_budget(x, run_x, y, run_y, square).value();
  EXPECT_EQ(all[0].figure, "EC0Y_urad");
  EXPECT_EQ(all[0].value, alone.value);
  EXPECT_EQ(all[0].U, alone.U);
  EXPECT_EQ(all[1].U, budget(RunBudgets::create(x, run_x).value(), "EYX_slope_urad").U);
  // The drift of D contributes 2 µrad, as above. The drifts of B and C contribute the same through
  // the roll: 20 mm / (2 · 10 mm) = 1.
  EXPECT_NEAR(all[1].u, 2e-6 * std::sqrt(3.0), 1e-10);
  EXPECT_EQ(all[2].figure, "EXY_slope_urad");
}

// D measures a slope of 3 µrad along X. Turned to Y, D measures -δx, and EXY has a slope of +5
// µrad. A scale error of 1000 ppm changes these slopes by 3 and 5 nrad. The changes have the same
// sign if the probe is the same, and are independent if the certificates differ.
TEST(Budget, CommonProbeIsOneQuantityOfSquareness) {
  const SquareArtefact square{.angle_error_rad = 0, .u_rad = 0, .corner = -1};
  const auto u = [&](const std::string& of_x, const std::string& of_y, std::uint64_t trials) {
    const Rig x = rig_x_with("D", of_x), y = rig_y(of_y);
    SyntheticRun along_x{.rig = x, .runs = 1}, along_y{.rig = y, .runs = 1};
    along_x.truth = [](double d) { return Errors5{3e-6 * d, 0, 0, 0, 0}; };
    along_y.truth = [](double d) { return Errors5{-5e-6 * d, 0, 0, 0, 0}; };
    return squareness_budget(x, along_x.measure(), y, along_y.measure(), square, {trials}).value();
  };
  const std::string scale = "u_sensitivity_ppm = 1000\n";
  const Budget same = u(scale, scale, 20000);
  EXPECT_NEAR(same.u, 8e-9, 1e-12);
  EXPECT_NEAR(contribution(same, "X and Y, probe D: sensitivity"), -8e-9, 1e-12);
  ASSERT_TRUE(same.trials);
  EXPECT_NEAR(same.trials->u / same.u, 1, 0.02);
  // The other rig declares twice the u of the same quantity: 3 nrad plus 2 · 5 nrad.
  const Budget other_u = u(scale, "u_sensitivity_ppm = 2000\n", 0);
  EXPECT_NEAR(other_u.u, 13e-9, 1e-12);
  EXPECT_NEAR(contribution(other_u, "X and Y, probe D: sensitivity"), -13e-9, 1e-12);
  const Budget two = u(scale + "certificate = \"1\"\n", scale + "certificate = \"2\"\n", 0);
  EXPECT_NEAR(two.u, std::hypot(3e-9, 5e-9), 1e-12);
  EXPECT_NEAR(contribution(two, "Y, probe D: sensitivity"), -5e-9, 1e-12);
}

// The first error of four targets at 0, 10, 20 and 30 mm is 0, 0, 3 and 1. The line by least
// squares is 0.1 + 0.6 per target; the residuals are -0.1, -0.7, 1.7 and -0.9.
TEST(Figures, MatchManualCalculationForFourTargets) {
  MeanErrors means;
  const double y[] = {0, 0, 3, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    TargetMean mean;
    mean.target = static_cast<int>(i) + 1;
    mean.position_m = 0.01 * static_cast<double>(i);
    mean.named = {y[i], 2 * y[i], 3 * y[i], 0, -y[i]};
    means.targets.push_back(mean);
  }
  const double left[] = {-0.1, -0.7, 1.7, -0.9};
  for (const std::size_t k : {0u, 1u}) {
    const auto by = static_cast<double>(k + 1);
    const Figure straightness = straightness_figure(Axis::x, k);
    const auto deviations = straightness.deviations(means);
    ASSERT_EQ(deviations.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(deviations[i], by * left[i], 1e-12);
    EXPECT_NEAR(straightness.of(means), by * 2.6, 1e-12);
    EXPECT_NEAR(slope_figure(Axis::x, k).of(means), by * 60, 1e-9);
  }
  EXPECT_EQ(range_figure(Axis::x, 2).of(means), 9);
  EXPECT_EQ(range_figure(Axis::x, 4).of(means), 3);
  EXPECT_EQ(error_figure(Axis::x, 1, 3).of(means), 6);
  EXPECT_TRUE(std::isnan(error_figure(Axis::x, 1, 5).of(means)));
  const auto at = errors_at_target(Axis::x, 3);
  ASSERT_EQ(at.size(), 5u);
  EXPECT_EQ(at[4].of(means), -3);
  // If the target moves against the encoder, the slope has the opposite sign.
  means.sides.against_encoder = true;
  EXPECT_NEAR(slope_figure(Axis::x, 0).of(means), -60, 1e-9);
  // A slope and a straightness need three targets, a range needs two.
  means.targets.resize(2);
  EXPECT_TRUE(std::isnan(straightness_figure(Axis::x, 0).of(means)));
  EXPECT_TRUE(std::isnan(slope_figure(Axis::x, 0).of(means)));
  EXPECT_EQ(range_figure(Axis::x, 0).of(means), 0);
  means.targets.resize(1);
  EXPECT_TRUE(std::isnan(range_figure(Axis::x, 0).of(means)));
  std::vector<std::string> names;
  for (const Figure& figure : figures_of_run(Axis::y)) names.push_back(figure.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "EXY_straightness_um", "EXY_slope_urad", "EZY_straightness_um",
                       "EZY_slope_urad", "EAY_range_urad", "EBY_range_urad", "ECY_range_urad"}));
}

// A trial has the same value if fewer trials are requested, in whole blocks or in a part of a
// block.
TEST(Budget, TrialsDoNotDependOnTheirNumber) {
  const Rig rig = rig_x_with("D", "u_calibration_um = 0.1");
  const auto budgets =
      RunBudgets::create(rig, SyntheticRun{.rig = rig, .model = Model::exact}.measure()).value();
  const std::vector<Figure> figures = {error_figure(Axis::x, 0, 5),
                                       straightness_figure(Axis::x, 0)};
  const auto many = budgets.draw(figures, {200, 3}), block = budgets.draw(figures, {128, 3});
  for (std::size_t f = 0; f < 2; ++f) {
    ASSERT_EQ(many[f].size(), 200u);
    ASSERT_EQ(block[f].size(), 128u);
    for (std::size_t t = 0; t < 128; ++t) EXPECT_EQ(many[f][t], block[f][t]) << t;
  }
}

// The 40 trials are 1 ... 40 in any order. 2.5 % of 40 is one trial, so one trial is below the
// interval, and none is above 40.
TEST(Budget, SummaryOfTrialsMatchesManualCalculation) {
  std::vector<double> trials;
  for (int i = 0; i < 40; ++i) trials.push_back(1 + (i * 7) % 40);
  const BudgetTrials summary = summary_of(trials, 9);
  EXPECT_EQ(summary.trials, 40u);
  EXPECT_EQ(summary.seed, 9u);
  EXPECT_EQ(summary.low, 2);
  EXPECT_EQ(summary.high, 40);
  EXPECT_NEAR(summary.u, std::sqrt((40 * 40 - 1) / 12.0 * 40 / 39), 1e-12);
}

// In each trial the range is the highest minus the lowest deviation. The standard deviation of the
// trials equals the u of the budget.
TEST(Budget, RangeIsDrawnAsHighestMinusLowest) {
  const Rig rig = rig_x_with("D", "u_sensitivity_ppm = 1000");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .runs = 1};
  synthetic.truth = [](double d) { return Errors5{1e-6 * std::sin(200 * d), 0, 0, 0, 0}; };
  const auto budgets = RunBudgets::create(rig, synthetic.measure()).value();
  const Figure straightness = straightness_figure(Axis::x, 0);
  const auto values = budgets.draw({straightness}, {500, 4}).front();
  double mean = 0;
  for (const double v : values) mean += v / 500;
  EXPECT_NEAR(mean / straightness.of(budgets.means()), 1, 2e-4);
  EXPECT_NEAR(summary_of(values, 4).u / straightness.of(budgets.means()), 1e-3, 1e-4);
  EXPECT_NEAR(budgets.trials(straightness, {500, 4}).u / summary_of(values, 4).u, 1, 0.01);
}

// Two runs are enough for a scatter of the slope: s = 1.4142 µrad, u = s/√2, with one degree of
// freedom.
TEST(Budget, TwoRunsAreEnoughForAScatter) {
  const Rig rig = rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 2};
  synthetic.added = [](std::size_t k, double d, double, double time_s) {
    return k == 3 || k == 4 ? (time_s < 182 ? 1e-6 : -1e-6) * d : 0.0;
  };
  const Budget slope =
      budget(RunBudgets::create(rig, synthetic.measure()).value(), "EYX_slope_urad");
  EXPECT_NEAR(slope.u_random, 1e-6, 1e-10);
  EXPECT_FALSE(slope.is_single_run);
}

// Visits are missing, and the passes have different levels. Some parts shift several means
// together, other parts shift the means of a pass. Only one run has all targets, so the scatter of
// the runs adds nothing.
TEST(Budget, PartsThatShiftSeveralMeansAddInQuadrature) {
  const Rig rig = rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  synthetic.u_reading_m = 1e-9;
  constexpr std::array<double, 6> kLevel_nm = {170, -60, 230, -310, 40, -120};
  int reading = 0;
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    ++reading;
    const double white_nm = 20 * std::sin(1.7 * reading * reading);
    const double level_nm = kLevel_nm.at(static_cast<std::size_t>((time_s - 5) / 90));
    return 1e-9 * (white_nm + (k < 3 ? 0 : level_nm));
  };
  auto run = synthetic.measure();
  std::erase_if(run.points, [](const MeasuredPoint& p) {
    const bool forward = p.point.direction > 0;
    return (p.run == 2 && (p.target == 9 || (!forward && p.target < 6))) ||
           (p.run == 3 && (!forward || p.target > 3));
  });
  RunBudgets budgets(rig, run);
  const Repeatability random =
      repeatability(run.header.moving(), run.points, budgets.means().targets);
  const std::size_t parts = random.together.size() + random.of_passes.size();
  ASSERT_FALSE(random.together.empty());
  ASSERT_FALSE(random.of_passes.empty());
  EXPECT_EQ(budgets.cost(), 9 * (1 + parts));

  const auto weight = [](std::size_t i, std::size_t k) {
    const double x = static_cast<double>(i);
    return k == 0 ? 1.3 - 0.4 * x : k == 4 ? 0.002 * x * x - 0.05 : 0;
  };
  const auto along = [&](auto&& value) {  // figure calculated from values [target][error]
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
      for (std::size_t k = 0; k < kErrorCount; ++k) sum += weight(i, k) * value(i, k);
    return sum;
  };
  const Figure figure{
      "f", [&](const MeanErrors& means) {
        return along([&](std::size_t i, std::size_t k) { return means.targets[i].named[k]; });
      }};
  double square = std::pow(along([&](std::size_t, std::size_t k) { return random.u_shift[k]; }), 2);
  for (std::size_t i = 0; i < 9; ++i)
    square += std::pow(
        along([&](std::size_t j, std::size_t k) { return i == j ? random.u[i][k] : 0; }), 2);
  const double alone = square;
  for (const auto* all : {&random.together, &random.of_passes}) {
    const double before = square;
    for (const auto& part : *all)
      square += std::pow(along([&](std::size_t i, std::size_t k) { return part[i][k]; }), 2);
    EXPECT_GT(square, before + 1e-3 * alone);
  }
  EXPECT_NEAR(budgets.first_order(figure).u_random, std::sqrt(square), 1e-7 * std::sqrt(square));

  budgets.add({{}, "key", {1e-9}, 1e6, "um", nullptr},
              std::vector<PointShifts>(4, PointShifts(run.points.size())));
  budgets.add({{}, "key", {1e-9}, 1e6, "um", nullptr},
              std::vector<PointShifts>(3, PointShifts(run.points.size())));
  EXPECT_EQ(budgets.cost(), 9 * (1 + parts + 7));
}

}  // namespace
}  // namespace mdof::algo
