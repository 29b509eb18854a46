// One turn of a bent tool with three teeth: convergence to the equilibrium, the cutting window, and
// the power.
#include "algo/milling/cut_turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/milling/milling.h"

namespace mdof::algo {
namespace {

constexpr ChipModel kChips[] = {ChipModel::sine, ChipModel::eq8, ChipModel::trochoid};
constexpr DeflectionModel kFlexibleModels[] = {DeflectionModel::paper, DeflectionModel::steady};

MillingPlan deflected_cut(ChipModel chip, DeflectionModel deflection, bool up) {
  MillingPlan plan = parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
  plan.teeth = 3;
  plan.helix_rad = 0.5;
  plan.runout_m = 0.3e-6;
  plan.runout_angle_rad = 0.4;
  plan.chip = chip;
  plan.deflection = deflection;
  plan.is_up = up;
  plan.elements = 2;
  plan.steps_per_turn = 360;
  return plan;
}

// In each step Newton's method squares the distance from the root, so four steps reduce some µm to
// 1e-13 m. With a wrong derivative, tens of steps would be necessary.
TEST(CutTurn, EquilibriumIsFoundInFourSteps) {
  for (const ChipModel chip : kChips)
    for (const DeflectionModel deflection : kFlexibleModels)
      for (const bool up : {true, false}) {
        const auto turn = cut_turn(deflected_cut(chip, deflection, up));
        ASSERT_TRUE(turn) << turn.error().message;
        EXPECT_LE(turn->iterations, chip == ChipModel::trochoid ? 5 : 4);
        EXPECT_GT(deflection_m(deflected_cut(chip, deflection, up), *turn, 0).cwiseAbs().maxCoeff(),
                  0.5e-6);
      }
}

// If the plan has an edge force, Eq. 8 has separate derivatives for thick chips.
TEST(CutTurn, EquilibriumWithEdgeForceNeedsFourSteps) {
  for (const bool up : {true, false}) {
    MillingPlan plan = deflected_cut(ChipModel::eq8, DeflectionModel::paper, up);
    plan.Kte = 2e3;
    plan.Kre = 3e3;
    EXPECT_LE(cut_turn(plan)->iterations, 4);
  }
}

// At the free edge, the tip of the bent tool leaves or enters the uncut side of the work.
TEST(CutTurn, WindowEndsAtTheFreeEdgeOfTheBentTool) {
  for (const DeflectionModel deflection : kFlexibleModels)
    for (const bool up : {true, false}) {
      const MillingPlan plan = deflected_cut(ChipModel::sine, deflection, up);
      const CutTurn turn = *cut_turn(plan);
      const CuttingEdge edge(plan, 0, turn.height_m[0]);
      const double at = up ? turn.exit_rad : turn.entry_rad, r = plan.radius_m();
      EXPECT_EQ(up ? turn.entry_rad : turn.exit_rad, up ? 0 : kHalfTurn_rad);
      const auto n = static_cast<Eigen::Index>(edge.turned(at) / (kWholeTurn_rad / 360) + 0.5);
      const double u_y = deflection_m(plan, turn, turn.height_m[0])(n % 360, 1);
      EXPECT_NEAR(r * std::cos(at) + u_y, (up ? 1 : -1) * (r - plan.radial_depth_m), 0.02e-6) << up;
      EXPECT_GT(std::abs(u_y), 0.05e-6);
    }
}

// Expected power: tangential force of the only tooth in the work times its speed. The tangential
// force is the component of the force on the tool along the path of the tooth.
TEST(CutTurn, PowerIsTangentialForceTimesSpeed) {
  for (const ChipModel chip : kChips)
    for (const bool up : {true, false}) {
      MillingPlan plan = deflected_cut(chip, DeflectionModel::steady, up);
      plan.Kte = chip == ChipModel::eq8 ? 2e3 : 0;
      const CutTurn turn = *cut_turn(plan);
      const double turns = kWholeTurn_rad * plan.spindle_hz;
      const double feed = plan.feed_per_tooth_m * plan.teeth / kWholeTurn_rad;
      int compared = 0;
      for (std::size_t n = 0; n < 360; ++n) {
        double power = 0;
        bool one_in_each = true;
        for (std::size_t m = 0; m < 2; ++m) {
          const auto i = static_cast<Eigen::Index>(n), k = static_cast<Eigen::Index>(m);
          int in = 0;
          for (int tooth = 0; tooth < 3; ++tooth) {
            double a = CuttingEdge(plan, tooth, turn.height_m[m]).angle(turn.turned_rad[n]);
            if (up ? a < 0.05 || a > 1.7 : a < 1.45 || a > 3.1) continue;
            ++in;
            power += (turn.fx_N(i, k) * std::cos(a) + turn.fy_N(i, k) * std::sin(a)) * turns *
                     (plan.radius_m() + (chip == ChipModel::trochoid ? feed * std::cos(a) : 0));
          }
          one_in_each = one_in_each && in == 1;
        }
        if (!one_in_each) continue;
        ++compared;
        EXPECT_NEAR(turn.power_W[n], power, 1e-9 * power) << n;
      }
      EXPECT_GT(compared, 200);
    }
}

TEST(Milling, ResultsMatchTheTurnsOfBentAndRigidTool) {
  const MillingPlan plan = deflected_cut(ChipModel::sine, DeflectionModel::steady, true);
  MillingPlan rigid = plan;
  rigid.deflection = DeflectionModel::rigid;
  const auto found = milling(plan);
  ASSERT_TRUE(found) << found.error().message;
  const CutTurn turn = *cut_turn(plan), stiff = *cut_turn(rigid);
  const Eigen::MatrixXd force = turn.force_N(), rigid_force = stiff.force_N();
  const auto largest = [](const Eigen::MatrixXd& f, Eigen::Index k) {
    double most = 0;
    for (Eigen::Index i = 0; i < f.rows(); ++i) most = std::max(most, std::abs(f(i, k)));
    return most;
  };
  EXPECT_EQ(found->x_max_N, largest(force, 0));
  EXPECT_EQ(found->y_max_N, largest(force, 1));
  EXPECT_EQ(found->x_max_rigid_N, largest(rigid_force, 0));
  EXPECT_EQ(found->y_max_rigid_N, largest(rigid_force, 1));
  double x = 0, y = 0, power = 0, bent = 0, bent_rigid = 0;
  const Eigen::MatrixXd u = deflection_m(plan, turn, 0), v = deflection_m(plan, stiff, 0);
  for (Eigen::Index i = 0; i < 360; ++i) {
    x += force(i, 0) / 360;
    y += force(i, 1) / 360;
    power += turn.power_W[static_cast<std::size_t>(i)] / 360;
    bent = std::max(bent, std::hypot(u(i, 0), u(i, 1)));
    bent_rigid = std::max(bent_rigid, std::hypot(v(i, 0), v(i, 1)));
  }
  EXPECT_NEAR(found->x_mean_N, x, 1e-12);
  EXPECT_NEAR(found->y_mean_N, y, 1e-12);
  EXPECT_NEAR(found->power_W, power, 1e-12);
  EXPECT_NEAR(found->deflection_m, bent, 1e-18);
  EXPECT_NEAR(found->deflection_rigid_m, bent_rigid, 1e-18);
  EXPECT_GT(std::abs(bent - bent_rigid), 1e-9);
  EXPECT_EQ(found->entry_rad, turn.entry_rad);
  EXPECT_EQ(found->exit_rad, turn.exit_rad);
  EXPECT_EQ(found->iterations, turn.iterations);
}

TEST(Milling, RefusesADeflectionOfHalfTheRadius) {
  MillingPlan plan = deflected_cut(ChipModel::sine, DeflectionModel::rigid, true);
  const double bent_m = milling(plan)->deflection_m, E = plan.youngs_modulus_Pa;
  for (const double part : {0.99, 1.01}) {
    plan.youngs_modulus_Pa = E * bent_m / (part * plan.radius_m() / 2);
    const auto found = milling(plan);
    EXPECT_EQ(found.has_value(), part < 1);
    if (found) continue;
    EXPECT_NE(found.error().message.find("half of the tool's radius"), std::string::npos);
  }
}

}  // namespace
}  // namespace mdof::algo
