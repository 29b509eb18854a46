// Uncertainties calculated together equal those calculated separately. Trials drawn in blocks equal
// single trials. The sensitivities of the errors to the travel equal those of the solver.
#include "algo/uncertainty/stated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/sensitivity/random.h"
#include "algo/uncertainty/budget/budget_draws.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "algo/uncertainty/statistics/target_noise.h"
#include "schema/base/random.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using test::rig_x_with;

Run uneven_run(const Rig& rig) {
  SyntheticRun synthetic{.rig = rig};
  synthetic.truth = [](double d) {
    return Errors5{1e-5 * std::sin(90 * d), 2e-4 * d, 1e-2 * d, -3e-2 * d, 2e-2 * d};
  };
  synthetic.u_reading_m = 5e-9;
  // The visits scatter more than u_reading_m, so the scatter determines u; it has few degrees of
  // freedom.
  synthetic.added = [](std::size_t k, double, double, double time_s) {
    return 20e-9 * std::sin(static_cast<double>(k + 1) * time_s);
  };
  Run run = synthetic.measure();
  run.points.erase(run.points.begin() + 4, run.points.begin() + 7);
  run.points[9].errors.valid = false;
  return run;
}

Rig declared_rig() {
  return rig_x_with("D",
                    "u_calibration_um = 0.03\nu_sensitivity_ppm = 2000\nu_direction_mrad = 3\n"
                    "u_position_mm = [0.05, 0.05, 0.05]",
                    "[encoder]\nu_um = 1\n[installation]\nu_angle_mrad = [2, 2, 2]\n"
                    "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.05\n"
                    "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n");
}

TEST(Stated, BudgetsTogetherEqualSeparateBudgets) {
  const Rig rig = declared_rig();
  const auto run = uneven_run(rig);
  const StatedUncertainty stated = stated_uncertainty(rig, run);
  const RunUncertainty points = run_uncertainty(rig, run);
  ASSERT_EQ(stated.points.points.size(), points.points.size());
  EXPECT_EQ(stated.points.noise_only, points.noise_only);
  EXPECT_EQ(stated.points.not_declared, points.not_declared);
  for (std::size_t j = 0; j < points.points.size(); ++j) {
    if (!run.points[j].errors.valid) continue;
    EXPECT_EQ(stated.points.points[j].U, points.points[j].U) << j;
    EXPECT_GT(points.points[j].u[0], points.points[j].u_random[0]) << j;
  }
  ASSERT_TRUE(stated.figures);
  const auto figures = RunBudgets::create(rig, run).value();
  for (const Figure& figure : figures_of_run(Axis::x)) {
    const Budget together = stated.figures->of(figure), apart = figures.of(figure);
    EXPECT_EQ(together.U, apart.U) << figure.name;
    EXPECT_EQ(together.lines.size(), apart.lines.size());
    EXPECT_GT(together.u, together.u_random) << figure.name;
  }
}

TEST(Stated, ReportsTheErrorForPointsAndFigures) {
  const Rig rig = rig_x_with("D", "u_direction_mrad = 300");
  const StatedUncertainty stated = stated_uncertainty(rig, SyntheticRun{.rig = rig}.measure());
  EXPECT_TRUE(stated.points.noise_only);
  EXPECT_NE(stated.points.why.find("u_direction_mrad"), std::string::npos);
  ASSERT_FALSE(stated.figures);
  EXPECT_EQ(stated.figures.error().message, stated.points.why);
  const decltype(uneven_run(rig)) empty;
  EXPECT_FALSE(stated_uncertainty(rig, empty).figures);
  EXPECT_TRUE(stated_uncertainty(rig, empty).points.points.empty());
}

TEST(Stated, RigWithoutDeclarationsHasNoiseOnly) {
  const Rig rig = rig_x_with("", "");
  const StatedUncertainty stated = stated_uncertainty(rig, uneven_run(rig));
  EXPECT_TRUE(stated.points.noise_only);
  EXPECT_EQ(stated.points.why, "");
  ASSERT_TRUE(stated.figures);
  EXPECT_TRUE(stated.figures->of(figures_of_run(Axis::x)[0]).noise_only);
}

// The expected trials are calculated one by one with the scalar functions draw() and gaussian();
// the parts are differences of the means. The run has more parts than one addition combines, and
// more trials than one block contains.
TEST(Stated, TrialsMatchScalarDraws) {
  const Rig rig = declared_rig();
  const auto run = uneven_run(rig);
  const auto budgets = RunBudgets::create(rig, run).value();
  constexpr std::uint64_t kTrials = 150;
  const int target = 6;
  const auto drawn = budgets.draw({error_figure(Axis::x, 0, target)}, {kTrials, 11}, 3).front();
  const Budget budget = budgets.first_order(error_figure(Axis::x, 0, target));
  const auto declared = contributors(rig, run).value();
  ASSERT_EQ(budget.lines.size(), 1 + declared.size());
  const auto at_target = [&](const std::vector<MeasuredPoint>& points) {
    for (const TargetMean& m : target_means(run.header.moving(), points, Approach::both))
      if (m.target == target) return m.named[0];
    return 0.0;
  };
  std::vector<double> parts;
  for (const Contributor& contributor : declared)
    for (const PointShifts& part : contributor.parts()) {
      auto points = run.points;
      shift(points, part);
      parts.push_back(at_target(points) - at_target(run.points));
    }
  EXPECT_NE(parts.size() % 4, 0u);  // some parts remain after the groups of four
  double noise_freedom = 0;
  for (const BudgetLine& line : budget.lines)
    if (line.key.empty()) noise_freedom = line.freedom;
  Distribution of_noise;
  of_noise.kind = Distribution::Kind::t;
  of_noise.spread = 1;
  of_noise.dof = noise_freedom;
  const QuantileFunction noise(of_noise);
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    double value = budget.value + budget.u_random * noise.at(draw({11, 3}, trial, 0));
    for (std::size_t p = 0; p < parts.size(); ++p)
      value += parts[p] * gaussian(draw({11, 3}, trial, p + 1));
    EXPECT_NEAR(drawn[trial], value, 1e-9 * budget.u) << trial;
  }
}

// The sensitivities to the travel come from the gain matrix. They are compared with solutions of
// the same readings at a slightly different travel.
TEST(Stated, TravelSensitivityMatchesTheSolver) {
  for (const Rig& rig : {test::rig_x(), test::rig_oblique()}) {
    const auto run = uneven_run(rig);
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const auto found = point_sensitivities(solver, run);
    constexpr double kStep_m = 1e-5;
    for (std::size_t j = 0; j < run.points.size(); ++j) {
      const MeasuredPoint& p = run.points[j];
      if (!p.errors.valid) continue;
      const auto at = [&](double travel_m) {
        return restate(solver.solve(travel_m, p.point.probe_m, p.point.probe_u_m), Model::rigid,
                       {Axis::x, {}}, travel_m, kAtCarriage, run.header.stated)
            .local;
      };
      const double d = found[j].travel_m;
      const Errors5 above = at(d + kStep_m), below = at(d - kStep_m);
      for (std::size_t e = 0; e < kErrorCount; ++e)
        EXPECT_NEAR(found[j].by_travel[e], (above[e] - below[e]) / (2 * kStep_m), 1e-8) << j;
    }
  }
}

// Three targets, one shift that is common to all targets, and two parts that shift several targets.
TEST(TargetNoiseByHand, AddsTargetNoiseShiftAndParts) {
  Repeatability random;
  for (const double u : {1.0, 2.0, 5.0}) random.u.push_back({u, 0, 3 * u, 0, -u});
  random.u_shift = {0.5, 0, 0, 0, 7};
  random.together = {{{1, 0, 0, 0, 0}, {0, 2, 0, 0, 0}, {0, 0, 3, 0, 0}},
                     {{4, 0, 0, 0, 1}, {0, 0, 0, 5, 0}, {0, 0, 0, 0, 0}}};
  constexpr std::size_t kTrials = 6;
  BlockOfDraws draws({5, 2}, 0, kTrials);
  const TargetNoise noise(draws, random);
  BlockOfDraws again({5, 2}, 0, kTrials);
  const UnitQuantity normal(std::numeric_limits<double>::infinity());
  std::vector<std::vector<double>> drawn;  // [targets, shift, freedom, parts]
  for (int q = 0; q < 7; ++q) drawn.push_back(again.next(normal));
  for (std::size_t t = 0; t < kTrials; ++t) {
    MeanErrors means;
    means.targets.resize(3);
    means.targets[1].named[0] = 100;
    noise.add_to(means, t, 0.5);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 5; ++k) {
        double expected = (i == 1 && k == 0 ? 100 : 0) +
                          0.5 * (drawn[i][t] * random.u[i][k] + drawn[3][t] * random.u_shift[k]);
        for (std::size_t p = 0; p < 2; ++p)
          expected += 0.5 * drawn[5 + p][t] * random.together[p][i][k];
        EXPECT_NEAR(means.targets[i].named[k], expected, 1e-13) << t << i << k;
      }
    // Wilson and Hilferty: χ²/ν is about the cube of 1 - 2/9ν + z √(2/9ν).
    const double v = 2 / (9 * 4.0), root = 1 - v + drawn[4][t] * std::sqrt(v);
    EXPECT_NEAR(noise.student(t, 4), 1 / std::sqrt(root * root * root), 1e-12);
    EXPECT_EQ(noise.student(t, std::numeric_limits<double>::infinity()), 1);
  }
}

}  // namespace
}  // namespace mdof::algo
