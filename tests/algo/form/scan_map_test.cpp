#include "algo/form/scan_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

double part_m(double x, double y) {
  return 2e-6 + 3e-5 * x - 1e-5 * y + 4e-3 * x * x + 7e-3 * x * y - 5e-3 * y * y;
}

// Circles about (0, 0) with the radii r from `first_mm` to `last_mm` in steps of 1 mm. The angle
// between points is `step_rad` / r.
ScanPoints rings(double first_mm, double last_mm, double step_rad) {
  ScanPoints points;
  for (double r = first_mm; r < last_mm + 0.5; r += 1)
    for (double angle = 0; angle < 6.28; angle += step_rad / r) {
      points.x_m.push_back(r * 1e-3 * std::cos(angle));
      points.y_m.push_back(r * 1e-3 * std::sin(angle));
      points.z_m.push_back(part_m(points.x_m.back(), points.y_m.back()));
    }
  return points;
}

// On the circles and between them the map must reproduce a parabola. Outside the largest and inside
// the smallest circle it has no heights.
TEST(ScanMap, ReproducesAScannedParabola) {
  const auto found = scan_map(rings(6, 20, 0.5), 1e-3);
  ASSERT_TRUE(found) << found.error().message;
  const SurfaceMap* const map = &found->map;
  EXPECT_EQ(found->u.z_m.size(), map->z_m.size());
  // Pixels at 20 mm have points on one side only, so the map ends at 19 mm.
  EXPECT_EQ(map->nx, 39u);
  EXPECT_EQ(map->ny, 39u);
  EXPECT_NEAR(map->x0_m, -19e-3, 1e-15);
  EXPECT_FALSE(std::isnan(map->at(0, 19)) || std::isnan(map->at(38, 19)));
  std::size_t between = 0;
  for (std::size_t j = 0; j < map->ny; ++j)
    for (std::size_t i = 0; i < map->nx; ++i) {
      const double x = map->x_m(i), y = map->y_m(j), r = std::hypot(x, y), z = map->at(i, j);
      if (r > 8e-3 && r < 18e-3) {
        ++between;
        EXPECT_NEAR(z, part_m(x, y), 2e-10) << x << " " << y;
      }
      if (r < 2e-3 || r > 21.5e-3) {
        EXPECT_TRUE(std::isnan(z)) << x << " " << y;
      }
    }
  EXPECT_GT(between, 700u);
}

// If a pixel has more points, their noise has less effect.
TEST(ScanMap, AveragesNoise) {
  ScanPoints points = rings(1, 20, 0.02);
  double sign = 1;
  for (double& z : points.z_m) z += (sign = -sign) * 1e-6;
  const auto found = scan_map(points, 1e-3);
  ASSERT_TRUE(found) << found.error().message;
  const SurfaceMap* const map = &found->map;
  double square = 0;
  for (std::size_t j = 0; j < map->ny; ++j)
    for (std::size_t i = 0; i < map->nx; ++i)
      if (std::hypot(map->x_m(i), map->y_m(j)) < 15e-3)
        square += std::pow(map->at(i, j) - part_m(map->x_m(i), map->y_m(j)), 2);
  EXPECT_LT(std::sqrt(square / 700), 0.1e-6);
}

// In 100 scans with known noise, 95.4 % of the heights must be within 2 u of the true height. The
// mean square of error / u must be 1.
TEST(ScanMap, UContainsTheTruth) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0, 0.2e-6);
  double within = 0, pixels = 0, square = 0, noise = 0;
  for (int scan = 0; scan < 100; ++scan) {
    ScanPoints points = rings(1, 12, 0.4);
    for (double& z : points.z_m) z += normal(engine);
    const auto found = scan_map(points, 1e-3);
    noise += found->noise_m / 100;
    for (std::size_t j = 0; j < found->map.ny; ++j)
      for (std::size_t i = 0; i < found->map.nx; ++i) {
        const double z = found->map.at(i, j), u = found->u.at(i, j);
        ASSERT_EQ(std::isnan(z), std::isnan(u));
        if (std::isnan(z)) continue;
        const double off = (z - part_m(found->map.x_m(i), found->map.y_m(j))) / u;
        within += std::abs(off) <= 2 ? 1 : 0;
        square += off * off;
        pixels += 1;
      }
  }
  EXPECT_NEAR(noise, 0.2e-6, 0.01e-6);
  EXPECT_NEAR(100 * within / pixels, 95.4, 1);
  EXPECT_NEAR(square / pixels, 1, 0.06);
}

TEST(ScanMap, RefusesInvalidScans) {
  EXPECT_FALSE(scan_map({}, 1e-3));
  const auto one_line = scan_map({{0, 1e-3, 2e-3, 3e-3}, {0, 0, 0, 0}, {0, 0, 0, 0}}, 1e-3);
  ASSERT_FALSE(one_line);
  EXPECT_NE(one_line.error().message.find("more densely"), std::string::npos);
  const auto too_many = scan_map(rings(1, 20, 0.5), 1e-6);
  ASSERT_FALSE(too_many);
  EXPECT_NE(too_many.error().message.find("larger"), std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
