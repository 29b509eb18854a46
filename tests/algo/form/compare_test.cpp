// Maps of a known surface that is shifted, turned and tilted. The tests check the pose found and
// the difference that remains.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/form/map_figures.h"
#include "algo/form/registration.h"
#include "algo/form/surface.h"
#include "tests/algo/form/known_maps.h"

namespace mdof::algo {
namespace {

// The point p of the surface A is in B at R p + shift.
SurfaceMap moved(double sx_m, double sy_m, double turn_deg, double x0_m, double d_m,
                 std::size_t nx) {
  const double c = std::cos(turn_deg * kDeg), s = std::sin(turn_deg * kDeg);
  return map_of(
      [=](double x, double y) {
        const double u = x - sx_m, v = y - sy_m;
        return bumps(c * u + s * v, -s * u + c * v) + 3e-6 + 40e-6 * x - 70e-6 * y;
      },
      x0_m, -25e-3, d_m, nx, 121);
}

TEST(FormCompare, FindsShiftAndTurn) {
  const SurfaceMap a = map_of(bumps);
  struct Case {
    double sx_mm, sy_mm, turn_deg;
  };
  for (const Case& k : {Case{0.3, -0.21, 0}, Case{-1.7, 2.9, 1.5}, Case{5, -4, -4}}) {
    const SurfaceMap b = moved(k.sx_mm * 1e-3, k.sy_mm * 1e-3, k.turn_deg, -40e-3, 0.41e-3, 196);
    const auto found = compare(a, b, Register::rigid);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->pose.shift_x_m, k.sx_mm * 1e-3, 2e-7);
    EXPECT_NEAR(found->pose.shift_y_m, k.sy_mm * 1e-3, 2e-7);
    EXPECT_NEAR(found->pose.turn_rad / kDeg, k.turn_deg, 5e-4);
    EXPECT_LT(found->rms_m, 0.05e-9);
    EXPECT_LT(found->pv_m, 2e-9);
    EXPECT_EQ(found->undetermined, 0u);
    EXPECT_GT(found->pixels, 7000u);
  }
}

TEST(FormCompare, RegistrationsPlaneAndNoneDoNotMoveTheMap) {
  const SurfaceMap a = map_of(bumps);
  const SurfaceMap b =
      map_of([](double x, double y) { return 2 * bumps(x, y) + 1e-6 + 1e-5 * x - 2e-5 * y; });
  const auto none = compare(a, b, Register::none);
  // B - A contains the bumps and the plane.
  EXPECT_NEAR(none->difference.at(7, 5),
              bumps(a.x_m(7), a.y_m(5)) + 1e-6 + 1e-5 * a.x_m(7) - 2e-5 * a.y_m(5), 1e-18);
  const auto plane = compare(a, b, Register::plane);
  SurfaceMap flat = a;
  remove_plane(flat);
  EXPECT_NEAR(plane->rms_m, figures_of(flat).rms_m, 1e-15);
  EXPECT_EQ(plane->pose.shift_x_m, 0);
  EXPECT_EQ(plane->undetermined, 0u);
  EXPECT_EQ(none->undetermined, 0u);
  EXPECT_EQ(plane->pixels, a.z_m.size());
}

TEST(FormCompare, CountsUndeterminedMovements) {
  const auto ball = [](double x, double y) { return (x * x + y * y) / 2; };
  const SurfaceMap a = map_of(ball);
  const auto found =
      compare(a, map_of([&](double x, double y) { return ball(x - 1e-3, y); }), Register::rigid);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->undetermined, 3u);
  EXPECT_NEAR(found->pose.shift_x_m, 0, 1e-9);
  EXPECT_LT(found->rms_m, 1e-12);
  // Waves along x only: the map determines the turn, but not the shift along y.
  const auto waves = [](double x, double) { return 1e-6 * std::sin(x / 5e-3); };
  const auto along =
      compare(map_of(waves), map_of([&](double x, double y) { return waves(x - 0.4e-3, y); }),
              Register::rigid);
  EXPECT_EQ(along->undetermined, 1u);
  EXPECT_NEAR(along->pose.shift_x_m, 0.4e-3, 1e-7);
}

TEST(FormCompare, AcceptsHolesAndRefusesMapsWithoutOverlap) {
  SurfaceMap a = map_of(bumps), b = map_of(bumps, -30.2e-3, -20.1e-3);
  for (std::size_t j = 30; j < 50; ++j)
    for (std::size_t i = 20; i < 60; ++i) b.z_m[j * b.nx + i] = SurfaceMap::kMissing;
  const auto found = compare(a, b, Register::none);
  ASSERT_TRUE(found);
  EXPECT_LT(found->pv_m, 2e-9);  // also true for pixels beside the hole
  EXPECT_LT(found->pixels, 9801u - 20u * 40u);
  const auto far = compare(a, map_of(bumps, 200e-3), Register::rigid);
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().message.find("counterpart"), std::string::npos);
  EXPECT_NE(far.error().message.find("only 0 of 9801"), std::string::npos);
  EXPECT_NE(far.error().message.find("(the first map covers x -30 to 30 mm, y -20 to 20 mm, the "
                                     "second map covers x 200 to 260 mm, y -20 to 20 mm)"),
            std::string::npos)
      << far.error().message;
}

TEST(Surface, IsExactAtPixelsAndContinuous) {
  const SurfaceMap a = map_of(bumps);
  const Surface surface(a, 3, Extension::line);
  SurfacePoint p;
  ASSERT_TRUE(surface.at(a.x_m(0), a.y_m(80), 0, p));
  EXPECT_DOUBLE_EQ(p.z_m, a.at(0, 80));
  double worst = 0, slope = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = -29e-3 + k * 0.029e-3, y = 19e-3 - k * 0.019e-3, h = 1e-9;
    SurfacePoint before, after;
    ASSERT_TRUE(surface.at(x, y, 0, p) && surface.at(x - h, y, 0, before) &&
                surface.at(x + h, y, 0, after));
    worst = std::max(worst, std::abs(p.z_m - bumps(x, y)));
    slope = std::max(slope, std::abs((after.z_m - before.z_m) / (2 * h) - p.slope_x));
  }
  EXPECT_LT(worst, 0.05e-9);
  EXPECT_LT(slope, 1e-7);
  // The surface extends three pixels beyond the edge if three are requested, and 0 pixels if 0 are
  // requested.
  EXPECT_FALSE(surface.at(-30.1e-3, 0, 0, p));
  EXPECT_TRUE(surface.at(-31.5e-3, 0, 3, p));
  EXPECT_NEAR(p.z_m, bumps(-31.5e-3, 0), 0.15e-6);
  EXPECT_FALSE(surface.at(-31.6e-3, 0, 3, p));
}

// The true pose is far from the start of the search: about 9 degrees in either direction, and 8 mm.
TEST(FormCompare, SearchesForLargeTurnsAndShifts) {
  const SurfaceMap a = map_of(bumps);
  for (const double turn_deg : {9.5, -9.0}) {
    const auto found =
        compare(a, moved(8e-3, -6e-3, turn_deg, -45e-3, 0.5e-3, 181), Register::rigid);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->pose.turn_rad / kDeg, turn_deg, 1e-3);
    EXPECT_NEAR(found->pose.shift_x_m, 8e-3, 1e-6);
    EXPECT_NEAR(found->pose.shift_y_m, -6e-3, 1e-6);
    EXPECT_LT(found->rms_m, 0.5e-9);
  }
}

// Waves do not determine the shift along their crests. This shift must be 0 at the middle of the
// measured part of A; B is turned about this point.
TEST(FormCompare, UndeterminedShiftIsZeroInTheMiddle) {
  const auto waves = [](double x, double) { return 1e-6 * std::sin(x / 5e-3) + 4e-5 * x; };
  SurfaceMap a = map_of(waves);
  for (std::size_t j = 0; j < a.ny; ++j)
    for (std::size_t i = 0; i < a.nx; ++i)
      if (a.x_m(i) < -6.1e-3 || a.x_m(i) > 24.1e-3 || a.y_m(j) > 4.1e-3)
        a.z_m[j * a.nx + i] = SurfaceMap::kMissing;
  const double x_mid_m = 9e-3, y_mid_m = -8e-3, c = std::cos(2 * kDeg), s = std::sin(2 * kDeg);
  const auto found = compare(a, map_of([&](double x, double y) {
                               return waves(x_mid_m + c * (x - x_mid_m) + s * (y - y_mid_m), 0);
                             }),
                             Register::rigid);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->undetermined, 1u);
  EXPECT_NEAR(found->pose.turn_rad / kDeg, 2, 1e-3);
  EXPECT_NEAR(found->pose.shift_x_m, x_mid_m - (c * x_mid_m - s * y_mid_m), 2e-5);
  EXPECT_NEAR(found->pose.shift_y_m, y_mid_m - (s * x_mid_m + c * y_mid_m), 2e-5);
}

// The part is shifted and turned by 180 degrees or by another large angle.
TEST(FormCompare, FindsAnyTurn) {
  const SurfaceMap a = map_of(bumps);
  for (const double turn_deg : {180.0, 90.0, -90.0, 133.0, -47.0, 178.0}) {
    const auto found =
        compare(a, moved(1e-3, -2e-3, turn_deg, -45e-3, 0.5e-3, 181), Register::rigid);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(std::remainder(found->pose.turn_rad / kDeg - turn_deg, 360), 0, 1e-3) << turn_deg;
    EXPECT_LE(std::abs(found->pose.turn_rad), 180 * kDeg) << turn_deg;
    EXPECT_NEAR(found->pose.shift_x_m, 1e-3, 1e-6);
    EXPECT_NEAR(found->pose.shift_y_m, -2e-3, 1e-6);
    EXPECT_LT(found->rms_m, 0.5e-9);
    EXPECT_EQ(found->undetermined, 0u);
  }
}

SurfaceMap with_noise(SurfaceMap map, unsigned seed, double sd_m) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, sd_m);
  for (double& z : map.z_m) z += normal(engine);
  return map;
}

// A plane and a sphere determine no movement. A cylinder (here along y) and a ridge determine the
// turn only. The noise of both maps is independent. A real shape with the same noise determines all
// movements.
TEST(FormCompare, NoiseDeterminesNoMovement) {
  const auto plane = [](double, double) { return 0.0; };
  const auto ball = [](double x, double y) { return (x * x + y * y) / 2; };
  const auto cylinder = [](double x, double) { return x * x / 2; };
  const auto count = [](const auto& shape, unsigned seed) {
    const auto found = compare(with_noise(map_of(shape), seed, 20e-9),
                               with_noise(map_of(shape), seed + 100, 20e-9), Register::rigid);
    EXPECT_TRUE(found);
    return found->undetermined;
  };
  for (const unsigned seed : {1u, 2u, 3u}) {
    EXPECT_EQ(count(plane, seed), 3u);
    EXPECT_EQ(count(ball, seed), 3u);
    EXPECT_EQ(count(cylinder, seed), 2u);
    EXPECT_EQ(count(bumps, seed), 0u);
  }
}

// B is turned about the middle of A and not shifted. Only the turn shows that the iteration is not
// finished.
TEST(FormCompare, FindsATurnWithoutShift) {
  const SurfaceMap a = map_of(bumps);
  const auto found = compare(a, moved(0, 0, -3, -40e-3, 0.41e-3, 196), Register::rigid);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->pose.turn_rad / kDeg, -3, 5e-5);
  EXPECT_NEAR(found->pose.shift_x_m, 0, 2e-8);
  EXPECT_NEAR(found->pose.shift_y_m, 0, 2e-8);
}

}  // namespace
}  // namespace mdof::algo
