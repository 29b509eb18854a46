#include "algo/milling/cutting_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/milling/beam.h"
#include "algo/milling/wall.h"

namespace mdof::algo {
namespace {

constexpr double kThird_rad = kWholeTurn_rad / 3;

// A tool with three teeth, helix, and run-out with tilt. No quantity is 0, and no two are equal.
MillingPlan three_teeth(ChipModel chip, DeflectionModel deflection) {
  MillingPlan plan = parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
  plan.teeth = 3;
  plan.helix_rad = 0.5;
  plan.runout_m = 1e-6;
  plan.runout_angle_rad = 0.4;
  plan.runout_tilt = 2e-3;
  plan.chip = chip;
  plan.deflection = deflection;
  plan.elements = 2;
  plan.steps_per_turn = 360;
  return plan;
}

// One vector describes the offset between the axes of tool and spindle. The vector is the same for
// all teeth at one height and rotates with the tool. The angle between a tooth and tooth 0 is its
// pitch plus the angle of the helix.
TEST(CuttingEdge, ToothFollowsTheRunout) {
  const MillingPlan plan = three_teeth(ChipModel::sine, DeflectionModel::rigid);
  const double r = plan.diameter_m / 2, z = 0.2e-3;
  for (const int tooth : {0, 1, 2})
    for (const double turned : {0.1, 1.9, 4.0, 6.2}) {
      const CuttingEdge edge(plan, tooth, z);
      const double a = edge.angle(turned);
      const double expected = turned - tooth * kThird_rad - z * std::tan(0.5) / r;
      EXPECT_NEAR(std::remainder(a - expected, kWholeTurn_rad), 0, 1e-13);
      EXPECT_GE(a, 0);
      EXPECT_LT(a, kWholeTurn_rad);
      EXPECT_NEAR(std::remainder(edge.turned(a) - turned, kWholeTurn_rad), 0, 1e-13);
      EXPECT_GE(edge.turned(a), 0);
      EXPECT_LT(edge.turned(a), kWholeTurn_rad);
      const double off = 1e-6 + 2e-3 * z;
      EXPECT_NEAR(edge.x(a), r * std::sin(expected) + off * std::sin(turned + 0.4), 1e-17);
      EXPECT_NEAR(edge.y(a), r * std::cos(expected) + off * std::cos(turned + 0.4), 1e-17);
    }
  EXPECT_EQ(wrapped_angle(0), 0);
  EXPECT_NEAR(wrapped_angle(-0.25), kWholeTurn_rad - 0.25, 1e-15);
  EXPECT_NEAR(wrapped_angle(3 * kWholeTurn_rad + 0.25), 0.25, 1e-14);
}

// Eq. 8 equals the trochoid chip to the second order of the feed. If the feed is halved, the
// difference is an eighth.
TEST(CuttingEdge, Eq8MatchesTheTrochoidToSecondOrder) {
  for (const double angle : {0.4, 0.9, 1.3, 1.8, 2.4}) {
    const auto difference = [&](double feed_m) {
      MillingPlan plan = three_teeth(ChipModel::eq8, DeflectionModel::rigid);
      plan.runout_m = plan.runout_tilt = 0;
      plan.feed_per_tooth_m = feed_m;
      MillingPlan exact = plan;
      exact.chip = ChipModel::trochoid;
      return std::abs(CuttingEdge(plan, 1, 0).rigid_chip(angle).thickness -
                      CuttingEdge(exact, 1, 0).rigid_chip(angle).thickness);
    };
    EXPECT_LT(difference(5e-6), difference(10e-6) / 5 + 1e-13) << angle;
    EXPECT_LT(difference(10e-6), 10e-6 * std::pow(10.0 / 250, 2)) << angle;
  }
}

// The run-out increases the thickness of a chip by the distance by which its tooth reaches further
// than the tooth before.
TEST(CuttingEdge, SineChipContainsTheRunoutStep) {
  const MillingPlan plan = three_teeth(ChipModel::sine, DeflectionModel::rigid);
  const double z = 0.1e-3, off = 1e-6 + 2e-3 * z, lag = z * std::tan(0.5) / plan.radius_m();
  for (const int tooth : {0, 1, 2}) {
    const double gamma = 0.4 + lag + tooth * kThird_rad;
    EXPECT_NEAR(CuttingEdge(plan, tooth, z).rigid_chip(0.7).thickness,
                plan.feed_per_tooth_m * std::sin(0.7) +
                    off * (std::cos(gamma) - std::cos(gamma - kThird_rad)),
                1e-17);
  }
}

// If the tool is bent against the feed, the chip is thinner at 90 degrees. If it is bent into the
// wall, the chip is thicker at 0 degrees. Material that the tooth before did not cut because of its
// deflection is added to the chip.
TEST(CuttingEdge, SteadyChipUsesBothDeflections) {
  for (const ChipModel model : {ChipModel::sine, ChipModel::eq8, ChipModel::trochoid}) {
    const MillingPlan plan = three_teeth(model, DeflectionModel::steady);
    const CuttingEdge edge(plan, 1, 0);
    const auto more = [&](double angle, const Deflection& now, const Deflection& earlier) {
      const Chip rigid = edge.rigid_chip(angle);
      return edge.chip(angle, rigid, now, earlier).thickness - rigid.thickness;
    };
    EXPECT_NEAR(more(kHalfTurn_rad / 2, {2e-6, 5e-6}, {}), -2e-6, 1e-17);
    EXPECT_NEAR(more(kHalfTurn_rad / 2, {}, {3e-6, 7e-6}), 3e-6, 1e-17);
    EXPECT_NEAR(more(0, {2e-6, 5e-6}, {}), 5e-6, 1e-17);
    EXPECT_NEAR(more(0, {}, {3e-6, 7e-6}), -7e-6, 1e-17);
  }
}

// By Eq. 9, the deflection reduces the feed.
TEST(CuttingEdge, PaperChipUsesTheFeedLessTheDeflection) {
  for (const ChipModel model : {ChipModel::sine, ChipModel::eq8}) {
    const MillingPlan plan = three_teeth(model, DeflectionModel::paper);
    MillingPlan less = plan;
    less.feed_per_tooth_m -= 2e-6;
    for (const double angle : {0.3, 1.2, 2.0}) {
      const CuttingEdge edge(plan, 2, 1e-4);
      EXPECT_NEAR(edge.chip(angle, edge.rigid_chip(angle), {2e-6, 4e-6}, {1e-6, 1e-6}).thickness,
                  CuttingEdge(less, 2, 1e-4).rigid_chip(angle).thickness, 1e-17);
    }
  }
}

TEST(CuttingEdge, ChipDerivativesMatchDifferences) {
  for (const ChipModel model : {ChipModel::sine, ChipModel::eq8, ChipModel::trochoid})
    for (const DeflectionModel deflection :
         {DeflectionModel::rigid, DeflectionModel::paper, DeflectionModel::steady}) {
      const MillingPlan plan = three_teeth(model, deflection);
      const CuttingEdge edge(plan, 1, 0.1e-3);
      const double angle = 0.8, d = 1e-8;
      const Chip rigid = edge.rigid_chip(angle);
      const auto thickness = [&](double x, double y, double before_x, double before_y) {
        return edge.chip(angle, rigid, {1e-6 + x, 2e-6 + y}, {3e-6 + before_x, 4e-6 + before_y})
            .thickness;
      };
      const Chip chip = edge.chip(angle, rigid, {1e-6, 2e-6}, {3e-6, 4e-6});
      EXPECT_NEAR(chip.by_x, (thickness(d, 0, 0, 0) - thickness(-d, 0, 0, 0)) / (2 * d), 1e-7);
      EXPECT_NEAR(chip.by_y, (thickness(0, d, 0, 0) - thickness(0, -d, 0, 0)) / (2 * d), 1e-7);
      EXPECT_NEAR(chip.by_earlier_x, (thickness(0, 0, d, 0) - thickness(0, 0, -d, 0)) / (2 * d),
                  1e-7);
      EXPECT_NEAR(chip.by_earlier_y, (thickness(0, 0, 0, d) - thickness(0, 0, 0, -d)) / (2 * d),
                  1e-7);
    }
}

// At the free edge the tooth, with its run-out and deflection, is on the straight line of the side
// of the work.
TEST(CuttingEdge, TrochoidLeavesTheWorkAtItsSide) {
  for (const bool up : {true, false})
    for (const int tooth : {0, 1, 2}) {
      MillingPlan plan = three_teeth(ChipModel::trochoid, DeflectionModel::steady);
      plan.is_up = up;
      plan.radial_depth_m = 0.18e-3;
      const CuttingEdge edge(plan, tooth, 0.1e-3);
      const double side = plan.radius_m() - 0.18e-3;
      EXPECT_NEAR(edge.y(edge.free_side_angle({1e-6, 3e-6})) + 3e-6, up ? side : -side, 1e-12);
      EXPECT_NEAR(edge.wall_side_angle(), up ? -kHalfTurn_rad / 2 : 1.5 * kHalfTurn_rad, 1e-15);
    }
  MillingPlan slot = three_teeth(ChipModel::sine, DeflectionModel::rigid);
  slot.radial_depth_m = slot.diameter_m;
  EXPECT_NEAR(CuttingEdge(slot, 0, 0).free_side_angle({0, 1e-6}), kHalfTurn_rad, 1e-15);
  EXPECT_EQ(CuttingEdge(slot, 0, 0).wall_side_angle(), 0);
}

// Expected compliance: the sum, over short pieces of the tool, of the product of both lever arms
// divided by the bending stiffness.
TEST(Beam, ComplianceOfASteppedToolMatchesASum) {
  const std::vector<ToolSection> tool = {{3e-3, 3e-3}, {1e-3, 1.5e-3}, {2e-3, 0.4e-3}};
  const double E = 600e9;
  const auto sum = [&](double at_m, double of_m) {
    constexpr int kPieces = 60000;
    const double piece = 6e-3 / kPieces;
    double bent = 0;
    for (int k = 0; k < kPieces; ++k) {
      const double height = 6e-3 - (k + 0.5) * piece;
      if (height < at_m || height < of_m) continue;
      const double d = height > 3e-3 ? 3e-3 : height > 2e-3 ? 1.5e-3 : 0.4e-3;
      bent += piece * (height - at_m) * (height - of_m) / (E * kHalfTurn_rad * d * d * d * d / 64);
    }
    return bent;
  };
  const std::vector<double> at = {0, 1.2e-3, 2.4e-3}, of = {0.3e-3, 3.5e-3};
  const auto C = beam_compliance(tool, E, at, of);
  ASSERT_EQ(C.rows(), 3);
  ASSERT_EQ(C.cols(), 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      EXPECT_NEAR(C(i, j) / sum(at[static_cast<std::size_t>(i)], of[static_cast<std::size_t>(j)]),
                  1, 1e-6);
}

// Shear by Cowper: κ = 6 (1 + ν) / (7 + 6 ν) for a circle, which is 0.879808 at ν = 0.22. The ratio
// of bending to shear for the length l is κ A l² / (3 · 2 (1 + ν) I) with A / I = 16 / d².
TEST(Beam, ShearMatchesCowper) {
  const double l = 2e-3, d = 0.4e-3;
  EXPECT_NEAR(shear_share({{l, d}}), 3 * 2.44 * d * d / (0.879808 * 16 * l * l), 1e-7);
  // Two halves of a cylinder have the same share of shear as the whole cylinder.
  EXPECT_NEAR(shear_share({{l / 2, d}, {l / 2, d}}), shear_share({{l, d}}), 1e-15);
}

// The expected force on each element follows from its chip. The chip depends on the deflection by
// these forces, now and one tooth pitch before.
TEST(CutTurn, SteadyForcesMatchTheirDeflection) {
  MillingPlan plan = three_teeth(ChipModel::sine, DeflectionModel::steady);
  plan.Kte = 2e3;
  plan.Kre = 3e3;
  const auto solved = cut_turn(plan);
  ASSERT_TRUE(solved) << solved.error().message;
  const double dz = plan.axial_depth_m / 2, step = kWholeTurn_rad / 360;
  int compared = 0;
  for (const Eigen::Index m : {0, 1}) {
    const double z = solved->height_m[static_cast<std::size_t>(m)];
    EXPECT_NEAR(z, (static_cast<double>(m) + 0.5) * dz, 1e-15);
    const auto u = deflection_m(plan, *solved, z);
    const double lag = z * std::tan(0.5) / plan.radius_m();
    for (Eigen::Index n = 0; n < 360; ++n) {
      const Eigen::Index before = (n + 240) % 360;
      const double exit = std::acos(1 - (plan.radial_depth_m + u(n, 1)) / plan.radius_m());
      double fx = 0, fy = 0;
      bool clear = true;
      for (const int tooth : {0, 1, 2}) {
        const double a = wrapped_angle(static_cast<double>(n) * step - lag - tooth * kThird_rad);
        if (a < step || a > kWholeTurn_rad - step || std::abs(a - exit) < step) clear = false;
        if (a > exit) continue;
        const double gamma = 0.4 + lag + tooth * kThird_rad, off = 1e-6 + 2e-3 * z;
        const double h = plan.feed_per_tooth_m * std::sin(a) +
                         off * (std::cos(gamma) - std::cos(gamma - kThird_rad)) +
                         (u(before, 0) - u(n, 0)) * std::sin(a) +
                         (u(n, 1) - u(before, 1)) * std::cos(a);
        if (h > -1e-8 && h < 3e-8) clear = false;
        if (h <= 0) continue;
        const double t = (plan.Kt * h + 2e3) * dz, r = (plan.Kr * h + 3e3) * dz;
        fx += t * std::cos(a) + r * std::sin(a);
        fy += t * std::sin(a) - r * std::cos(a);
      }
      if (!clear) continue;
      ++compared;
      EXPECT_NEAR(solved->fx_N(n, m), fx, 2e-6) << n;
      EXPECT_NEAR(solved->fy_N(n, m), fy, 2e-6) << n;
    }
  }
  EXPECT_GT(compared, 600);
}

// Expected: the outermost position of all teeth over some turns at each x, found by bisection on
// their exact paths.
TEST(Wall, IsTheEnvelopeOfAllTeeth) {
  for (const bool up : {true, false}) {
    MillingPlan plan = three_teeth(ChipModel::trochoid, DeflectionModel::rigid);
    plan.is_up = up;
    plan.runout_m = 0.05e-6;
    plan.runout_tilt = 0.5e-3;
    plan.steps_per_turn = 3600;
    const CutTurn turn = *cut_turn(plan);
    const double r = plan.radius_m(), feed = plan.feed_per_tooth_m * 3;
    for (const WallLine& line : wall_lines(plan, turn)) {
      const std::size_t cells = line.outward_m.size();
      EXPECT_EQ(cells, static_cast<std::size_t>(std::ceil(feed / plan.wall_grid_m)));
      const double off = 0.05e-6 + 0.5e-3 * line.height_m;
      for (std::size_t k = 0; k < cells; k += 7) {
        const double x = feed * static_cast<double>(k) / static_cast<double>(cells);
        double outermost = -1;
        for (const int tooth : {0, 1, 2})
          for (int before = -3; before <= 3; ++before) {
            const double lag = tooth * kThird_rad + line.height_m * std::tan(0.5) / r;
            const auto along = [&](double turned) {
              return feed * turned / kWholeTurn_rad + r * std::sin(turned - lag) +
                     off * std::sin(turned + 0.4);
            };
            const double wall = lag + kWholeTurn_rad * before + (up ? 0 : kHalfTurn_rad);
            double low = wall - 1, high = wall + 1;
            const bool rises = along(high) > along(low);
            for (int halving = 0; halving < 60; ++halving) {
              const double middle = (low + high) / 2;
              ((along(middle) < x) == rises ? low : high) = middle;
            }
            const double y = r * std::cos(low - lag) + off * std::cos(low + 0.4);
            if (std::abs(along(low) - x) < 1e-9) outermost = std::max(outermost, (up ? y : -y) - r);
          }
        EXPECT_NEAR(line.outward_m[k], outermost, 3e-10) << up << " " << k;
      }
    }
  }
}

// If the tool is bent away from the side of the work by more than the depth, it leaves or enters
// the work only at the wall.
TEST(CuttingEdge, BentAwayBeyondTheDepthCutsNothing) {
  MillingPlan plan = three_teeth(ChipModel::sine, DeflectionModel::rigid);
  plan.radial_depth_m = 1e-6;
  EXPECT_EQ(CuttingEdge(plan, 0, 0).free_side_angle({0, -5e-6}), 0);
  plan.is_up = false;
  EXPECT_EQ(CuttingEdge(plan, 0, 0).free_side_angle({0, 5e-6}), kHalfTurn_rad);
}

}  // namespace
}  // namespace mdof::algo
