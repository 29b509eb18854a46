// Tests how a cut changes with its inputs, where closed forms apply. For a rigid tool with one
// element, the force is proportional to the depth for all drawn inputs.
#include "algo/milling/milling_trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mdof::algo {
namespace {

// A cut of a rigid tool without helix and run-out, with few steps per turn.
MillingPlan rigid_cut() {
  MillingPlan plan = parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
  plan.elements = 1;
  plan.runout_m = plan.helix_rad = plan.runout_tilt = 0;
  plan.chip = ChipModel::sine;
  plan.deflection = DeflectionModel::rigid;
  plan.steps_per_turn = 180;
  return plan;
}
const MillingInput& input_of(double MillingPlan::*member) {
  for (const MillingInput& input : milling_inputs())
    if (input.member == member) return input;
  ADD_FAILURE() << "no such input";
  return milling_inputs().front();
}
const MillingInput& depth_input() {
  return input_of(&MillingPlan::axial_depth_m);
}

std::vector<std::vector<double>> outputs_of(const CausalExperiment& trials, std::uint64_t first,
                                            std::uint64_t step, std::size_t n,
                                            const std::vector<std::uint8_t>& second = {}) {
  std::vector<std::vector<double>> out(milling_outputs().size(), std::vector<double>(n));
  std::vector<double*> at;
  for (auto& column : out) at.push_back(column.data());
  trials.run_mixed(second, first, step, n, at);
  return out;
}

TEST(MillingInputs, VaryByDeclaredUOrOnePercent) {
  DeclaredMillingPlan declared{parse_milling_plan(micro_end_mill_preset(), "preset")->plan, {}};
  declared.plan.runout_m = 0;
  const MillingInput& feed = input_of(&MillingPlan::feed_per_tooth_m);
  declared.u = {{&depth_input(), 3e-6}, {&feed, 0}};
  std::size_t next = 0;
  const auto inputs = varying_inputs(declared);
  for (const MillingInput& input : milling_inputs()) {
    const double value = std::abs(declared.plan.*(input.member));
    if (value == 0 || &input == &feed) continue;
    ASSERT_LT(next, inputs.size());
    EXPECT_EQ(inputs[next].input, &input);
    const bool is_declared = &input == &depth_input();
    EXPECT_EQ(inputs[next].declared, is_declared) << input.key;
    EXPECT_NEAR(inputs[next].u, is_declared ? 3e-6 : 0.01 * value, 1e-12 * value) << input.key;
    ++next;
  }
  EXPECT_EQ(next, inputs.size());
}

TEST(MillingOutputs, HaveTheUnitsOfTheirNames) {
  MillingResult r;
  r.x_max_N = 1;
  r.y_max_N = 2;
  r.deflection_m = 3e-6;
  r.wall.offset_mean_m = 4e-6;
  r.wall.form_m = 5e-6;
  r.wall.waviness_tip_m = 6e-6;
  const auto values = milling_output_values(r);
  ASSERT_EQ(values.size(), milling_outputs().size());
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(values[k], static_cast<double>(k + 1), 1e-12);
  EXPECT_EQ(milling_outputs()[2], "deflection_um");
}

// The forces are proportional to the depth.
TEST(MillingEffects, AreProportionalToTheDepth) {
  const MillingPlan plan = rigid_cut();
  const auto nominal = milling_output_values(*milling(plan));
  const double depth = plan.axial_depth_m;
  const auto effects =
      milling_effects(plan, {{&depth_input(), 0.05 * depth}, {&depth_input(), 1.5 * depth, false}});
  ASSERT_TRUE(effects) << effects.error().message;
  ASSERT_EQ(effects->size(), 2u);
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_NEAR((*effects)[0][k], 0.05 * nominal[k], 1e-9);
    // u exceeds the depth, and a negative depth is impossible. The effect of u is therefore
    // calculated from the slope above the depth.
    EXPECT_NEAR((*effects)[1][k], 1.5 * nominal[k], 1e-9);
  }
  EXPECT_EQ((*effects)[0].size(), 6u);
}

TEST(MillingTrials, ConstantInputsGiveTheCutIn720Steps) {
  MillingPlan plan = rigid_cut();
  plan.steps_per_turn = 3600;
  const auto trials = milling_trials(plan, {{&depth_input(), 0}}, 1);
  plan.steps_per_turn = 720;
  const auto expected = milling_output_values(*milling(plan));
  const auto found = outputs_of(*trials, 5, 1, 1);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(found[k][0], expected[k]) << k;
  EXPECT_EQ(trials->outputs(), milling_outputs());
  EXPECT_EQ(trials->causes(), std::vector<std::string>{depth_input().name()});
}

TEST(MillingTrials, DrawInputsFromANormalDistribution) {
  const MillingPlan plan = rigid_cut();
  const double nominal = milling(plan)->x_max_N;
  const auto trials = milling_trials(plan, {{&depth_input(), 0.02 * plan.axial_depth_m}}, 7);
  constexpr std::size_t n = 400;
  const auto out = outputs_of(*trials, 0, 1, n);
  double mean = 0, square = 0, within = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double drawn = (out[0][j] / nominal - 1) / 0.02;
    mean += drawn / n;
    square += drawn * drawn / n;
    within += std::abs(drawn) < 1 ? 1. / n : 0;
    EXPECT_NEAR(out[1][j] / out[0][j], milling(plan)->y_max_N / nominal, 1e-9);
  }
  EXPECT_NEAR(mean, 0, 0.2);  // four standard deviations
  EXPECT_NEAR(square, 1, 0.29);
  EXPECT_NEAR(within, 0.683, 0.1);
  // A trial has the same values if other trials of a call are omitted. The second stream has other
  // values.
  const auto some = outputs_of(*trials, 3, 4, 5), second = outputs_of(*trials, 0, 1, 8, {1});
  for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(some[0][j], out[0][3 + 4 * j]);
  for (std::size_t j = 0; j < 8; ++j) EXPECT_NE(second[0][j], out[0][j]);
  EXPECT_EQ(outputs_of(*trials, 0, 1, 8, {0})[0][7], out[0][7]);
  double run[6];
  double* const at[] = {run, run + 1, run + 2, run + 3, run + 4, run + 5};
  trials->run(9, 1, 1, at);
  EXPECT_EQ(run[0], out[0][9]);
  EXPECT_NE(outputs_of(*milling_trials(plan, {{&depth_input(), 1e-6}}, 8), 9, 1, 1)[0][0], run[0]);
}

// Each input has its own random numbers. In turn, only one of two inputs has the values of the
// second stream.
TEST(MillingTrials, InputsAreIndependent) {
  const MillingPlan plan = rigid_cut();
  const MillingInput &kt = input_of(&MillingPlan::Kt), &kr = input_of(&MillingPlan::Kr);
  const auto trials =
      milling_trials(plan, {{&depth_input(), 0.02 * plan.axial_depth_m}, {&kt, 0.02 * plan.Kt}}, 7);
  const auto depth = milling_trials(plan, {{&depth_input(), 0.02 * plan.axial_depth_m}}, 7);
  const auto none = outputs_of(*trials, 0, 1, 4), first = outputs_of(*trials, 0, 1, 4, {1, 0}),
             last = outputs_of(*trials, 0, 1, 4, {0, 1}),
             both = outputs_of(*trials, 0, 1, 4, {1, 1});
  const auto alone = outputs_of(*depth, 0, 1, 4), alone_second = outputs_of(*depth, 0, 1, 4, {1});
  for (std::size_t j = 0; j < 4; ++j) {
    // The depth multiplies the force by the same factor for any Kt.
    EXPECT_NEAR(first[0][j] / none[0][j], alone_second[0][j] / alone[0][j], 1e-12);
    EXPECT_NEAR(both[0][j] / last[0][j], alone_second[0][j] / alone[0][j], 1e-12);
    EXPECT_NE(last[0][j], none[0][j]);
  }
  EXPECT_EQ(milling_trials(plan, {{&kr, 1}, {&kt, 1}}, 1)->causes().size(), 2u);
}

// The drawn inputs may describe a cut that is impossible.
TEST(MillingTrials, ImpossibleCutsAreNotSolved) {
  const auto is_solved = [](const MillingPlan& plan) {
    const auto trials = milling_trials(plan, {{&depth_input(), 0}}, 1);
    const auto out = outputs_of(*trials, 0, 1, 1);
    for (const auto& column : out) EXPECT_EQ(std::isnan(column[0]), std::isnan(out[0][0]));
    return !std::isnan(out[0][0]);
  };
  const MillingPlan cut = rigid_cut();
  EXPECT_TRUE(is_solved(cut));
  for (double MillingPlan::*const member :
       {&MillingPlan::feed_per_tooth_m, &MillingPlan::radial_depth_m, &MillingPlan::axial_depth_m,
        &MillingPlan::youngs_modulus_Pa, &MillingPlan::Kt})
    for (const double value : {0.0, -1e-9}) {
      MillingPlan none = cut;
      none.*member = value;
      EXPECT_FALSE(is_solved(none)) << value;
    }
  MillingPlan plan = cut;
  plan.radial_depth_m = 1.001 * plan.diameter_m;
  EXPECT_FALSE(is_solved(plan));
  plan.radial_depth_m = plan.diameter_m;
  EXPECT_TRUE(is_solved(plan));
  plan = cut;
  plan.axial_depth_m = 1.001 * plan.overhang_m();
  EXPECT_FALSE(is_solved(plan));
  plan.axial_depth_m = plan.overhang_m();
  EXPECT_EQ(is_solved(plan), bool(milling(plan)));
  plan = cut;
  plan.feed_per_tooth_m = 1.001 * plan.radius_m() / plan.teeth;
  EXPECT_FALSE(is_solved(plan));
  plan.feed_per_tooth_m = plan.radius_m() / plan.teeth;
  EXPECT_EQ(is_solved(plan), bool(milling(plan)));
  plan = cut;
  for (const double sign : {1.0, -1.0}) {
    plan.runout_m = sign * 0.1001 * plan.radius_m();
    EXPECT_FALSE(is_solved(plan));
    plan.runout_m = sign * 0.09 * plan.radius_m();
    EXPECT_EQ(is_solved(plan), bool(milling(plan)));
  }
}

// The height of an element is the height of its middle. The number of steps is a multiple of the
// number of teeth.
TEST(CutTurn, HasTheElementsAndStepsOfThePlan) {
  MillingPlan plan = rigid_cut();
  plan.elements = 4;
  plan.teeth = 4;
  plan.steps_per_turn = 181;
  const CutTurn turn = *cut_turn(plan);
  ASSERT_EQ(turn.height_m.size(), 4u);
  for (std::size_t m = 0; m < 4; ++m)
    EXPECT_NEAR(turn.height_m[m], plan.axial_depth_m * (0.125 + 0.25 * static_cast<double>(m)),
                1e-15);
  ASSERT_EQ(turn.turned_rad.size(), 184u);
  for (std::size_t n = 0; n < 184; ++n)
    EXPECT_NEAR(turn.turned_rad[n], 2 * std::numbers::pi * static_cast<double>(n) / 184, 1e-12);
  EXPECT_EQ(turn.fx_N.rows(), 184);
  EXPECT_EQ(turn.fx_N.cols(), 4);
  const Eigen::MatrixXd force = turn.force_N();
  EXPECT_NEAR(force(30, 0), turn.fx_N.row(30).sum(), 1e-15);
  EXPECT_NEAR(force(30, 1), turn.fy_N.row(30).sum(), 1e-15);
}

// On its trochoid, a tooth is faster by the feed where it cuts along the feed. The chip is h = f
// sin φ. To first order, a chip along the radius sweeps h (r - h / 2), but the force contains h r,
// which is more by the integral of h² / 2. Where the tip is at the free side, a triangle of h by h
// cos φ is not cut yet.
TEST(CutTurn, TrochoidPowerMatchesTheSweptVolume) {
  for (const bool up : {true, false}) {
    MillingPlan plan = rigid_cut();
    plan.chip = ChipModel::trochoid;
    plan.is_up = up;
    plan.steps_per_turn = 3600;
    const CutTurn turn = *cut_turn(plan);
    double mean = 0;
    for (const double p : turn.power_W) mean += p / static_cast<double>(turn.power_W.size());
    const double f = plan.feed_per_tooth_m, depth = plan.radial_depth_m, r = plan.radius_m();
    const double removed = f * plan.teeth * plan.spindle_hz * depth * plan.axial_depth_m;
    const double exit = std::acos(1 - depth / r);
    const double squares = exit / 2 - std::sin(2 * exit) / 4;
    const double triangle = -std::cos(exit) * std::sin(exit) * std::sin(exit);
    EXPECT_NEAR(mean / (plan.Kt * removed), 1 + f * (squares - triangle) / (2 * depth), 1.5e-3)
        << up;
  }
}

// Expected, element by element: the force on a tooth along its path, including the edge force,
// times its speed. The radial force does no work.
TEST(CutTurn, PowerIsForceTimesSpeedOfEachElement) {
  for (const bool up : {true, false}) {
    MillingPlan plan = rigid_cut();
    plan.deflection = DeflectionModel::steady;
    plan.teeth = 1;
    plan.is_up = up;
    plan.elements = 3;
    plan.helix_rad = 1;
    plan.Kte = 20e3;
    plan.Kre = 27e3;
    plan.steps_per_turn = 720;
    const CutTurn turn = *cut_turn(plan);
    const double speed = kWholeTurn_rad * plan.spindle_hz * plan.radius_m();
    double most = 0;
    for (std::size_t n = 0; n < 720; ++n) {
      double power = 0;
      for (const Eigen::Index m : {0, 1, 2}) {
        const auto row = static_cast<Eigen::Index>(n);
        const double z = turn.height_m[static_cast<std::size_t>(m)];
        const double a = CuttingEdge(plan, 0, z).angle(turn.turned_rad[n]);
        power += (turn.fx_N(row, m) * std::cos(a) + turn.fy_N(row, m) * std::sin(a)) * speed;
      }
      EXPECT_NEAR(turn.power_W[n], power, 1e-9) << up << " " << n;
      most = std::max(most, power);
    }
    EXPECT_GT(most, 1);
  }
}

TEST(Milling, MeansAndWindowMatchTheTurn) {
  MillingPlan plan = rigid_cut();
  EXPECT_EQ(milling(plan)->iterations, 1);
  plan.deflection = DeflectionModel::steady;
  plan.is_up = false;
  const CutTurn turn = *cut_turn(plan);
  const MillingResult found = *milling(plan);
  EXPECT_EQ(turn.force_N().cols(), 2);
  EXPECT_NEAR(found.x_mean_N, turn.fx_N.sum() / static_cast<double>(turn.fx_N.rows()), 1e-12);
  EXPECT_NEAR(found.y_mean_N, turn.fy_N.sum() / static_cast<double>(turn.fy_N.rows()), 1e-12);
  EXPECT_GT(std::abs(found.y_mean_N), 0.1);
  EXPECT_EQ(found.entry_rad, turn.entry_rad);
  EXPECT_EQ(found.exit_rad, turn.exit_rad);
  EXPECT_GT(found.entry_rad, 1);
  EXPECT_NEAR(found.exit_rad, kHalfTurn_rad, 0.02);
  EXPECT_GT(found.iterations, 1);
  EXPECT_LT(found.iterations, 15);
}

// The deflection is proportional to 1 / E. Its limit is half of the radius of the tool.
TEST(Milling, RefusesADeflectionBeyondHalfTheRadius) {
  MillingPlan plan = rigid_cut();
  plan.youngs_modulus_Pa *= milling(plan)->deflection_m / (plan.radius_m() / 2);
  plan.youngs_modulus_Pa *= 1.01;
  EXPECT_TRUE(milling(plan));
  plan.youngs_modulus_Pa *= 0.98;
  EXPECT_FALSE(milling(plan));
}

TEST(WallByHand, MatchesManualCalculationForThreeHeights) {
  const WallLine line{0, {1, 2, 6}};
  EXPECT_NEAR(line.mean_m(), 3, 1e-15);
  EXPECT_NEAR(line.waviness_m(), 5, 1e-15);
  EXPECT_NEAR(line.Ra_m(), (2 + 1 + 3) / 3.0, 1e-15);
}

// The mean over the depth is the mean of the elements. The tip and the root have separate results.
TEST(WallByHand, ResultsMatchTheLinesOfTheWall) {
  MillingPlan plan = parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
  plan.elements = 3;
  plan.steps_per_turn = 360;
  const CutTurn turn = *cut_turn(plan);
  const auto lines = wall_lines(plan, turn);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines.front().height_m, 0);
  EXPECT_EQ(lines.back().height_m, plan.axial_depth_m);
  for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(lines[m + 1].height_m, turn.height_m[m]);
  const WallFigures wall = milling(plan)->wall;
  double least = 1, most = -1;
  for (const WallLine& line : lines) {
    least = std::min(least, line.mean_m());
    most = std::max(most, line.mean_m());
  }
  EXPECT_GT(most - least, 1e-9);
  EXPECT_EQ(wall.form_m, most - least);
  EXPECT_NEAR(wall.offset_mean_m, (lines[1].mean_m() + lines[2].mean_m() + lines[3].mean_m()) / 3,
              1e-18);
  EXPECT_EQ(wall.offset_tip_m, lines[0].mean_m());
  EXPECT_EQ(wall.offset_root_m, lines[4].mean_m());
  EXPECT_EQ(wall.waviness_tip_m, lines[0].waviness_m());
  EXPECT_EQ(wall.waviness_root_m, lines[4].waviness_m());
  EXPECT_EQ(wall.Ra_tip_m, lines[0].Ra_m());
  EXPECT_EQ(wall.Ra_root_m, lines[4].Ra_m());
}

// A trial is solved if its run-out is at most a tenth of the radius, with either sign.
TEST(MillingTrials, RunoutIsLimitedToATenthOfTheRadius) {
  for (const double share : {-0.101, -0.099, 0.099, 0.101}) {
    MillingPlan plan = rigid_cut();
    plan.runout_m = share * plan.radius_m();
    const auto found = outputs_of(*milling_trials(plan, {{&depth_input(), 0}}, 1), 0, 1, 1);
    EXPECT_EQ(std::isfinite(found[0][0]), std::abs(share) < 0.1) << share;
  }
}

}  // namespace
}  // namespace mdof::algo
