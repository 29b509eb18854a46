#include "algo/milling/milling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/milling/beam.h"

namespace mdof::algo {
namespace {

constexpr double kPi = 3.14159265358979323846;

MillingPlan preset() {
  return parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
}

// A tool with one element, without helix and run-out, for which closed forms apply.
MillingPlan plain(ChipModel chip, DeflectionModel deflection) {
  MillingPlan plan = preset();
  plan.elements = 1;
  plan.runout_m = plan.helix_rad = 0;
  plan.chip = chip;
  plan.deflection = deflection;
  return plan;
}

double mean_power_W(const CutTurn& turn) {
  double sum = 0;
  for (const double p : turn.power_W) sum += p;
  return sum / static_cast<double>(turn.power_W.size());
}

TEST(Beam, MatchesTextbooks) {
  const double E = 600e9, d = 0.4e-3, l = 2e-3, I = kPi * std::pow(d, 4) / 64;
  const auto C = beam_compliance({{l, d}}, E, {0, 0.5e-3}, {0, 0.5e-3});
  EXPECT_NEAR(C(0, 0) / (l * l * l / (3 * E * I)), 1, 1e-12);
  // Eq. 2 of the paper with corrected symbols: the compliance is v² (3 l - v) / 6EI; l is the
  // length of the tool, v the distance of the force from its clamped end. It is the same if force
  // and point are exchanged.
  const double v = 1.5e-3;
  EXPECT_NEAR(C(0, 1) / (v * v * (3 * l - v) / (6 * E * I)), 1, 1e-12);
  EXPECT_EQ(C(0, 1), C(1, 0));
  // Two cylinders of the same diameter equal one cylinder. A thick shank increases the compliance
  // only slightly.
  const auto halves = beam_compliance({{0.7e-3, d}, {1.3e-3, d}}, E, {0}, {0});
  EXPECT_NEAR(halves(0, 0) / C(0, 0), 1, 1e-12);
  const double L = 3e-3, D = 3e-3, shank = kPi * std::pow(D, 4) / 64;
  const auto both = beam_compliance({{L, D}, {l, d}}, E, {0}, {0});
  const double expected =
      l * l * l / (3 * E * I) + (std::pow(l + L, 3) - l * l * l) / (3 * E * shank);
  EXPECT_NEAR(both(0, 0) / expected, 1, 1e-12);
}

TEST(Beam, ShearAddsTwoPercentAtFiveDiameters) {
  EXPECT_NEAR(shear_share({{5 * 0.4e-3, 0.4e-3}}), 0.020, 0.001);
  EXPECT_NEAR(shear_share({{20 * 0.4e-3, 0.4e-3}}), 0.0013, 0.0001);
}

TEST(CuttingEdge, RigidWindowMatchesTheCircle) {
  const MillingPlan plan = plain(ChipModel::sine, DeflectionModel::rigid);
  const double exit = std::acos((0.25 - 0.3) / 0.25);
  EXPECT_NEAR(CuttingEdge(plan, 0, 0).free_side_angle({}), exit, 1e-15);
  MillingPlan down = plan;
  down.is_up = false;
  EXPECT_NEAR(CuttingEdge(down, 0, 0).free_side_angle({}), kPi - exit, 1e-15);
  // If the tool is bent into the wall by 3 µm, an up cut leaves the work later and a down cut
  // enters the work later.
  EXPECT_NEAR(CuttingEdge(plan, 0, 0).free_side_angle({0, 3e-6}),
              std::acos((-50e-6 - 3e-6) / 250e-6), 1e-15);
  EXPECT_NEAR(CuttingEdge(down, 0, 0).free_side_angle({0, 3e-6}),
              std::acos((50e-6 - 3e-6) / 250e-6), 1e-15);
}

// Eq. 8 (Bao and Tansel) is compared with the exact trochoid. Without run-out, the difference is
// below 0.02 µm.
TEST(CuttingEdge, Eq8IsCloseToTheTrochoid) {
  for (const int teeth : {2, 4}) {
    MillingPlan eq8 = plain(ChipModel::eq8, DeflectionModel::rigid);
    eq8.teeth = teeth;
    MillingPlan exact = eq8;
    exact.chip = ChipModel::trochoid;
    for (double angle = 0.1; angle < 1.7; angle += 0.2)
      EXPECT_NEAR(CuttingEdge(eq8, 1, 0).rigid_chip(angle).thickness,
                  CuttingEdge(exact, 1, 0).rigid_chip(angle).thickness, 0.02e-6 * teeth / 2)
          << teeth << " " << angle;
    // A very small run-out changes both chips equally; the sign depends on the tooth.
    for (const int tooth : {0, 1}) {
      const auto moved = [&](MillingPlan plan) {
        const double before = CuttingEdge(plan, tooth, 0).rigid_chip(1.2).thickness;
        plan.runout_m = 1e-8;
        plan.runout_angle_rad = 0.7;
        return CuttingEdge(plan, tooth, 0).rigid_chip(1.2).thickness - before;
      };
      EXPECT_NEAR(moved(eq8), moved(exact), 2e-10) << teeth << " " << tooth;
      EXPECT_GT(std::abs(moved(exact)), 5e-10);
    }
  }
}

// If the run-out exceeds the feed, one tooth does not reach the work. The chip of the next tooth
// begins at the surface of the last tooth that did cut.
TEST(CuttingEdge, TrochoidChecksAllEarlierTeeth) {
  MillingPlan plan = plain(ChipModel::trochoid, DeflectionModel::rigid);
  plan.runout_m = 20e-6;
  plan.runout_angle_rad = 0;
  EXPECT_LT(CuttingEdge(plan, 1, 0).rigid_chip(kPi / 2).thickness, 0);
  const Chip chip = CuttingEdge(plan, 0, 0).rigid_chip(kPi / 2);
  EXPECT_EQ(chip.earlier, 2);
  EXPECT_NEAR(chip.thickness, 30e-6, 0.5e-6);  // two feeds
}

TEST(Milling, OneElementHasTheKnownForces) {
  const auto rigid = *milling(plain(ChipModel::sine, DeflectionModel::rigid));
  EXPECT_NEAR(rigid.x_max_N, 0.872, 5e-4);
  EXPECT_NEAR(rigid.y_max_N, 1.066, 5e-4);
  const auto paper = *milling(plain(ChipModel::eq8, DeflectionModel::paper));
  EXPECT_NEAR(paper.x_max_N, 0.728, 1e-3);
  EXPECT_NEAR(paper.y_max_N, 0.988, 5e-3);
  EXPECT_NEAR(paper.exit_rad * 180 / kPi, 102.3, 0.05);
  const auto steady = *milling(plain(ChipModel::sine, DeflectionModel::steady));
  EXPECT_NEAR(steady.x_max_N, 0.872, 5e-4);
  EXPECT_NEAR(steady.y_max_N, 1.068, 1e-3);
}

// The force is F = Kt h db and the speed r ω. So the mean power is exactly Kt times the removed
// volume per time.
TEST(Milling, PowerMatchesTheRemovedVolume) {
  for (const bool up : {true, false}) {
    MillingPlan plan = plain(ChipModel::sine, DeflectionModel::rigid);
    plan.is_up = up;
    const double removed = plan.feed_per_tooth_m * plan.teeth * plan.spindle_hz *
                           plan.radial_depth_m * plan.axial_depth_m;
    EXPECT_NEAR(mean_power_W(*cut_turn(plan)) / (plan.Kt * removed), 1, 1e-6);
    plan.elements = 7;
    plan.helix_rad = 0.5;
    EXPECT_NEAR(mean_power_W(*cut_turn(plan)) / (plan.Kt * removed), 1, 1e-6);
  }
}

TEST(Milling, TrochoidToothEntersBeforeAngleZero) {
  const auto turn = *cut_turn(plain(ChipModel::trochoid, DeflectionModel::rigid));
  EXPECT_NEAR(turn.entry_rad * 180 / kPi, -1.69, 0.01);
  EXPECT_NEAR(turn.exit_rad * 180 / kPi, 101.54, 0.01);
}

TEST(Wall, CuspMatchesTheTrochoid) {
  for (const bool up : {true, false}) {
    MillingPlan plan = plain(ChipModel::trochoid, DeflectionModel::rigid);
    plan.is_up = up;
    const auto result = *milling(plan);
    EXPECT_NEAR(result.wall.waviness_tip_m, up ? 0.10835e-6 : 0.11695e-6, 0.15e-9);
    EXPECT_NEAR(result.wall.form_m, 0, 1e-15);
    // The mean of a parabola is one third of its height below its top.
    EXPECT_NEAR(result.wall.offset_tip_m, -result.wall.waviness_tip_m / 3, 0.3e-9);
  }
}

// The tool has run-out and no deflection. The tooth that reaches further outward cuts the wall,
// which is shifted outward by the component of the run-out.
TEST(Wall, RunoutCutsOutward) {
  MillingPlan plan = plain(ChipModel::trochoid, DeflectionModel::rigid);
  plan.runout_m = 20e-6;  // tooth 1 does not cut, so the cusps are two feeds long
  plan.runout_angle_rad = 0;
  const auto result = *milling(plan);
  EXPECT_NEAR(result.wall.waviness_tip_m, 4 * 0.10835e-6 * 250 / 270, 0.02e-6);
  EXPECT_NEAR(result.wall.offset_tip_m, 20e-6 - result.wall.waviness_tip_m / 3, 0.01e-6);
}

// In equilibrium, the force of the chip with a deflection causes this deflection of the beam.
TEST(Milling, FindsEquilibriumWhereIterationDiverges) {
  for (const bool up : {true, false})
    for (const DeflectionModel model : {DeflectionModel::paper, DeflectionModel::steady}) {
      MillingPlan plan = preset();
      plan.is_up = up;
      plan.deflection = model;
      plan.sections.front().length_m = 4e-3;
      plan.steps_per_turn = 720;
      const auto result = milling(plan);
      ASSERT_TRUE(result) << result.error().message;
      EXPECT_GT(result->deflection_m, 10e-6);
    }
  MillingPlan plan = plain(ChipModel::eq8, DeflectionModel::paper);
  plan.sections.front().length_m = 4e-3;
  const auto turn = *cut_turn(plan);
  const auto u = deflection_m(plan, turn, turn.height_m.front());
  for (std::size_t n = 100; n < 1000; n += 100) {  // only tooth 0 is in the work
    const auto row = static_cast<Eigen::Index>(n);
    const double a = turn.turned_rad[n], f = plan.feed_per_tooth_m - u(row, 0), r = plan.radius_m();
    const double h = f * std::sin(a) - f * f * std::sin(a) * std::cos(a) / (kPi * r) +
                     f * f * std::cos(a) * std::cos(a) / (2 * r);
    const double b = plan.axial_depth_m;
    EXPECT_NEAR(turn.fx_N(row, 0), h * b * (plan.Kt * std::cos(a) + plan.Kr * std::sin(a)), 1e-6);
    EXPECT_NEAR(turn.fy_N(row, 0), h * b * (plan.Kt * std::sin(a) - plan.Kr * std::cos(a)), 1e-6);
  }
}

// Where the tooth leaves the work, a weak tool has several equilibria; one of them is unstable. The
// test uses chip models that differ by 0.02 µm in 15 µm. If one of them used the unstable
// equilibrium, the deflections would differ by 2.5 %.
TEST(Milling, StaysInTheStableEquilibrium) {
  const auto bent_m = [](ChipModel chip) {
    MillingPlan plan = preset();
    plan.chip = chip;
    plan.sections.front().length_m = 6e-3;
    plan.steps_per_turn = 720;
    const auto result = milling(plan);
    EXPECT_TRUE(result) << result.error().message;
    return result->deflection_m;
  };
  EXPECT_NEAR(bent_m(ChipModel::sine) / bent_m(ChipModel::eq8), 1, 2e-3);
}

// Eq. 9 in the middle of a down cut without Kr: u = k (f - u) with k = -C b Kt / 2 at 135 degrees
// (u: deflection, f: feed, C: compliance, b: depth). There the chip increases with its own
// deflection.
TEST(Milling, GrowingChipMatchesTheClosedForm) {
  MillingPlan plan = plain(ChipModel::sine, DeflectionModel::paper);
  plan.is_up = false;
  plan.Kr = 0;
  plan.sections.front().length_m = 3.8e-3;
  const double d = plan.sections.front().diameter_m, b = plan.axial_depth_m;
  const double I = kPi * std::pow(d, 4) / 64, l = 3.8e-3 - b / 2;
  const double k = -l * l * l / (3 * plan.youngs_modulus_Pa * I) * b * plan.Kt / 2;
  const auto turn = cut_turn(plan);
  ASSERT_TRUE(turn) << turn.error().message;
  const auto u = deflection_m(plan, *turn, turn->height_m.front());
  EXPECT_LT(k, -0.7);
  EXPECT_NEAR(u(1350, 0), plan.feed_per_tooth_m * k / (1 + k), 1e-9);
}

TEST(Milling, EdgeForceActsOnTheEdgeInTheWork) {
  MillingPlan plan = plain(ChipModel::sine, DeflectionModel::rigid);
  const auto without = *cut_turn(plan);
  plan.Kte = 2e3;
  plan.Kre = 3e3;
  const auto with = *cut_turn(plan);
  const double a = with.turned_rad[900], b = plan.axial_depth_m;  // the angle is 90 degrees
  EXPECT_NEAR(with.fx_N(900, 0) - without.fx_N(900, 0), b * (2e3 * std::cos(a) + 3e3 * std::sin(a)),
              1e-9);
  EXPECT_NEAR(with.fy_N(900, 0) - without.fy_N(900, 0), b * (2e3 * std::sin(a) - 3e3 * std::cos(a)),
              1e-9);
}

// If the offset is added to the radius of the tool, the mean of the wall is at its nominal
// position.
TEST(WearOffset, CompensatesTheMeanOfTheWall) {
  DeclaredMillingPlan declared{preset(), {}};
  const auto offset = *wear_offset(declared);
  const auto result = *milling(declared.plan);
  EXPECT_EQ(offset.offset_m, result.wall.offset_mean_m);
  EXPECT_GT(offset.offset_m, 0);  // the tool is bent into the wall and cuts too much
  EXPECT_TRUE(std::isnan(offset.u_m));
}

TEST(WearOffset, UncertaintyComesFromItsInputs) {
  DeclaredMillingPlan declared{preset(), {}};
  declared.plan.steps_per_turn = 720;
  for (const MillingInput& input : milling_inputs())
    if (std::string(input.key) == "radial_um") declared.u.emplace_back(&input, 0.1e-6);
  const auto offset = *wear_offset(declared);
  MillingPlan more = declared.plan, less = declared.plan;
  more.runout_m += 0.05e-6;
  less.runout_m -= 0.05e-6;
  const double slope =
      (milling(more)->wall.offset_mean_m - milling(less)->wall.offset_mean_m) / 0.1e-6;
  EXPECT_NEAR(offset.u_m, std::abs(slope) * 0.1e-6, 0.002e-6);
  EXPECT_GT(offset.u_m, 0.01e-6);
}

// If u would make the run-out negative, the run-out is limited to 0. The largest part comes first.
TEST(WearOffset, PartsAreWithinLimitsAndInOrder) {
  DeclaredMillingPlan declared{preset(), {}};
  declared.plan.steps_per_turn = 720;
  declared.plan.runout_m = 0.05e-6;
  const double u = 0.1e-6;
  for (const MillingInput& input : milling_inputs()) {
    if (std::string(input.key) == "feed_per_tooth_um") declared.u.emplace_back(&input, 1e-9);
    if (std::string(input.key) == "radial_um") declared.u.emplace_back(&input, u);
  }
  ASSERT_EQ(declared.u.size(), 2u);
  const auto offset = *wear_offset(declared);
  MillingPlan more = declared.plan, none = declared.plan;
  more.runout_m += u;
  none.runout_m = 0;
  const double change = milling(more)->wall.offset_mean_m - milling(none)->wall.offset_mean_m;
  ASSERT_EQ(offset.parts.size(), 2u);
  EXPECT_STREQ(offset.parts[0].input->key, "radial_um");
  EXPECT_NEAR(offset.parts[0].contribution_m, change / more.runout_m * u, 1e-12);
  EXPECT_GT(std::abs(offset.parts[0].contribution_m), std::abs(offset.parts[1].contribution_m));
  EXPECT_NEAR(offset.u_m,
              std::hypot(offset.parts[0].contribution_m, offset.parts[1].contribution_m), 1e-15);
}

TEST(WearOffset, AnglesAreEqualModuloAWholeTurn) {
  const auto u_of = [](double angle_deg) {
    DeclaredMillingPlan declared{preset(), {}};
    declared.plan.steps_per_turn = 720;
    declared.plan.runout_m = 1e-6;
    declared.plan.runout_angle_rad = angle_deg * M_PI / 180;
    for (const MillingInput& input : milling_inputs())
      if (std::string(input.key) == "angle_deg") declared.u.emplace_back(&input, M_PI / 36);
    return wear_offset(declared)->u_m;
  };
  for (const double angle_deg : {-90.0, -45.0, -120.0}) {
    EXPECT_NEAR(u_of(angle_deg), u_of(angle_deg + 360), 1e-12) << angle_deg;
    EXPECT_GT(u_of(angle_deg), 1e-9) << angle_deg;
  }
}

}  // namespace
}  // namespace mdof::algo
