// Tests the surface of a map: polynomials that its cubics reproduce exactly, its extension beyond
// the pixels, and its values where pixels for the slopes are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "algo/form/surface.h"
#include "tests/algo/form/known_maps.h"

namespace mdof::algo {
namespace {

constexpr double kColumn_m = 2e-3, kRow_m = 0.5e-3;

// A map of z(column, row); columns and rows are counted from 0.
SurfaceMap map_in_pixels(std::size_t nx, std::size_t ny,
                         const std::function<double(double, double)>& z) {
  SurfaceMap map{"pixels", 1e-3, -2e-3, kColumn_m, kRow_m, nx, ny, {}, {}};
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i)
      map.z_m.push_back(z(static_cast<double>(i), static_cast<double>(j)));
  return map;
}
// The surface at a column and a row, which may be fractions.
bool surface_at(const Surface& surface, double i, double j, std::size_t rings, SurfacePoint& p) {
  return surface.at(1e-3 + i * kColumn_m, -2e-3 + j * kRow_m, rings, p);
}
double height_at(const Surface& surface, double i, double j, std::size_t rings) {
  SurfacePoint p;
  EXPECT_TRUE(surface_at(surface, i, j, rings, p)) << i << ' ' << j;
  return p.z_m;
}

// Differences over five pixels are exact for polynomials to the fourth degree, the Hermite cubic to
// the third.
TEST(SurfacePolynomials, ReproduceCubicsAndTheirSlopes) {
  const auto f = [](double x) { return 1 + x * (0.7 + x * (-0.3 + 0.02 * x)); };
  const auto df = [](double x) { return 0.7 + x * (-0.6 + 0.06 * x); };
  const auto g = [](double y) { return -2 + y * (1.1 + y * (0.2 - 0.05 * y)); };
  const auto dg = [](double y) { return 1.1 + y * (0.4 - 0.15 * y); };
  const Surface surface(map_in_pixels(12, 11, [&](double i, double j) { return f(i) * g(j); }), 0,
                        Extension::parabola);
  for (const double i : {2.0, 3.1, 4.5, 7.9, 8.0})
    for (const double j : {2.0, 3.3, 5.5, 6.75, 7.0}) {
      SurfacePoint p;
      ASSERT_TRUE(surface_at(surface, i, j, 0, p));
      EXPECT_NEAR(p.z_m, f(i) * g(j), 1e-12);
      EXPECT_NEAR(p.slope_x * kColumn_m, df(i) * g(j), 1e-11);
      EXPECT_NEAR(p.slope_y * kRow_m, f(i) * dg(j), 1e-11);
    }
}

TEST(SurfacePolynomials, ContinueAParabola) {
  const auto z = [](double x, double y) { return (1 + x - 0.2 * x * x) * (2 - y + 0.1 * y * y); };
  const Surface surface(map_in_pixels(6, 7, z), 4, Extension::parabola);
  for (const double i : {-4.0, -3.5, 0.0, 2.5, 8.9, 9.0})
    for (const double j : {0.0, 2.25, 6.0})
      EXPECT_NEAR(height_at(surface, i, j, 4), z(i, j), 1e-10);
  for (const double j : {-4.0, -0.5, 6.5, 10.0})
    EXPECT_NEAR(height_at(surface, 3.5, j, 4), z(3.5, j), 1e-10);
  // The way to a pixel beyond a corner is along both directions. Each pixel on this way counts as a
  // ring.
  EXPECT_NEAR(height_at(surface, -2, -2, 4), z(-2, -2), 1e-10);
  SurfacePoint p;
  EXPECT_FALSE(surface_at(surface, -2, -3, 4, p));
  EXPECT_FALSE(surface_at(surface, -2, -2, 3, p));
  // Positions up to 0.01 pixel beyond the last pixel are accepted, so that rounding errors exclude
  // none.
  for (const double beyond : {0.009, 0.011}) {
    const bool is_there = beyond < 0.01;
    EXPECT_EQ(surface_at(surface, -4 - beyond, 3, 4, p), is_there);
    EXPECT_EQ(surface_at(surface, 9 + beyond, 3, 4, p), is_there);
    EXPECT_EQ(surface_at(surface, 3, -4 - beyond, 4, p), is_there);
    EXPECT_EQ(surface_at(surface, 3, 10 + beyond, 4, p), is_there);
  }
  EXPECT_NEAR(height_at(surface, 3, 10.009, 4), z(3, 10.009), 1e-10);
  EXPECT_FALSE(surface_at(surface, -1, 3, 0, p));
  EXPECT_FALSE(surface_at(surface, 1e6, 3, 4, p));
  EXPECT_FALSE(surface_at(surface, -1e6, 3, 4, p));
  EXPECT_FALSE(surface_at(surface, 3, 1e6, 4, p));
  EXPECT_FALSE(surface_at(surface, 3, -1e6, 4, p));
  EXPECT_FALSE(surface_at(surface, NAN, 3, 4, p));
}

// Value at 0 of the least-squares line through values at the distances 1, 2 ... n pixels.
double line_at_zero(const std::vector<double>& nearest_first) {
  const auto n = static_cast<double>(nearest_first.size());
  if (nearest_first.size() == 1) return nearest_first[0];
  double mean_x = (n + 1) / 2, mean = 0, xx = 0, xy = 0;
  for (const double z : nearest_first) mean += z / n;
  for (std::size_t k = 0; k < nearest_first.size(); ++k) {
    const double x = static_cast<double>(k + 1) - mean_x;
    xx += x * x;
    xy += x * nearest_first[k];
  }
  return mean - xy / xx * mean_x;
}

// A map with one row: only the pixels of this row determine its extension.
TEST(SurfaceExtension, IsTheLineThroughUpToFourPixels) {
  const std::vector<double> z = {3, 7, 4, 9, 5};
  for (std::size_t n = 1; n <= 5; ++n) {
    const Surface surface(map_in_pixels(n, 1, [&](double i, double) { return z[size_t(i)]; }), 2,
                          Extension::line);
    std::vector<double> left(z.begin(),
                             z.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(n, 4)));
    std::vector<double> right(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
    right = {right.rbegin(), right.rend()};
    if (right.size() > 4) right.resize(4);
    const double first_left = line_at_zero(left), first_right = line_at_zero(right);
    EXPECT_NEAR(height_at(surface, -1, 0, 2), first_left, 1e-12) << n;
    EXPECT_NEAR(height_at(surface, static_cast<double>(n), 0, 2), first_right, 1e-12) << n;
    // The second extended pixel uses the first extended pixel and the three nearest pixels.
    left.insert(left.begin(), first_left);
    if (left.size() > 4) left.resize(4);
    EXPECT_NEAR(height_at(surface, -2, 0, 2), line_at_zero(left), 1e-12) << n;
    // Across the row, each extended pixel has only one neighbour.
    EXPECT_NEAR(height_at(surface, 0, 1, 2), z[0], 1e-12);
    EXPECT_NEAR(height_at(surface, 0, -1, 2), z[0], 1e-12);
  }
}

TEST(SurfaceExtension, IsTheParabolaThroughThreePixels) {
  const std::vector<double> z = {3, 7, 4, 9, 5};
  const double expected[] = {3, 2 * 3 - 7, 3 * 3 - 3 * 7 + 4, 3 * 3 - 3 * 7 + 4, 3 * 3 - 3 * 7 + 4};
  for (std::size_t n = 1; n <= 5; ++n) {
    const Surface surface(map_in_pixels(1, n, [&](double, double j) { return z[size_t(j)]; }), 1,
                          Extension::parabola);
    EXPECT_NEAR(height_at(surface, 0, -1, 1), expected[n - 1], 1e-12) << n;
  }
}

// The value in a hole is the mean of the extensions from those sides that have the most pixels.
TEST(SurfaceExtension, HoleUsesTheSidesWithTheMostPixels) {
  SurfaceMap map = map_in_pixels(3, 3, [](double i, double j) { return i * i + 10 * j * j * j; });
  map.z_m[4] = SurfaceMap::kMissing;
  // The four neighbours of the hole are 0 + 10, 4 + 10, 1 + 0 and 1 + 80, one on each side.
  EXPECT_NEAR(height_at(Surface(map, 1, Extension::line), 1, 1, 1), (10 + 14 + 1 + 81) / 4.0,
              1e-12);
  SurfaceMap row = map_in_pixels(5, 1, [](double i, double) { return i * i * i; });
  row.z_m[1] = SurfaceMap::kMissing;
  // To the right of the hole are 8, 27 and 64, to the left is one pixel.
  EXPECT_NEAR(height_at(Surface(row, 1, Extension::line), 1, 0, 1), line_at_zero({8, 27, 64}),
              1e-12);
  row = map_in_pixels(5, 1, [](double i, double) { return i * i * i; });
  row.z_m[2] = SurfaceMap::kMissing;
  EXPECT_NEAR(height_at(Surface(row, 1, Extension::line), 2, 0, 1),
              (line_at_zero({1, 0}) + line_at_zero({27, 64})) / 2, 1e-12);
  SurfacePoint p;
  EXPECT_FALSE(surface_at(Surface(row, 1, Extension::line), 2, 0, 0, p));
  EXPECT_FALSE(surface_at(Surface(row, 1, Extension::line), 1.5, 0, 0, p));
  EXPECT_TRUE(surface_at(Surface(row, 1, Extension::line), 1, 0, 0, p));
}

// A map is extended by at most 254 pixels. The outermost extended pixels have no pixels beyond them
// for the slopes.
constexpr double kOutermost = 254;
TEST(SurfaceAtItsEnd, UsesThreePixelsThenStraightLines) {
  const auto f = [](double x) { return 1e-3 * x * x - 0.05 * x + 2; };
  const auto df = [](double x) { return 2e-3 * x - 0.05; };
  const auto g = [](double y) { return 1 - 0.01 * y + 2e-3 * y * y; };
  const auto dg = [](double y) { return -0.01 + 4e-3 * y; };
  const std::size_t n = 9;
  const Surface surface(map_in_pixels(n, n, [&](double i, double j) { return f(i) * g(j); }), 300,
                        Extension::parabola);
  SurfacePoint p;
  const double last = static_cast<double>(n) - 1;
  const auto expect_parabola = [&](double i, double j) {
    ASSERT_TRUE(surface_at(surface, i, j, 254, p)) << i << ' ' << j;
    EXPECT_NEAR(p.z_m, f(i) * g(j), 1e-6) << i << ' ' << j;
    EXPECT_NEAR(p.slope_x * kColumn_m, df(i) * g(j), 1e-6) << i << ' ' << j;
    EXPECT_NEAR(p.slope_y * kRow_m, f(i) * dg(j), 1e-6) << i << ' ' << j;
  };
  // Each slope is calculated from five or three pixels, which reproduces a parabola.
  for (const double in : {251.5, 252.0, 252.3, 252.9, 253.0}) {
    expect_parabola(-in, 4);
    expect_parabola(-in, 4.4);
    expect_parabola(4, -in);
    expect_parabola(4.7, -in);
  }
  for (const double in : {251.5, 252.0, 252.2, 252.8}) {
    expect_parabola(last + in, 4.4);
    expect_parabola(4.7, last + in);
  }
  // The surface is linear between the last two pixels.
  const auto expect_straight = [&](double i, double t, double j) {
    ASSERT_TRUE(surface_at(surface, i + t, j, 254, p)) << i << ' ' << j;
    EXPECT_NEAR(p.z_m, ((1 - t) * f(i) + t * f(i + 1)) * g(j), 1e-6);
    EXPECT_NEAR(p.slope_x * kColumn_m, (f(i + 1) - f(i)) * g(j), 1e-6);
    EXPECT_NEAR(p.slope_y * kRow_m, ((1 - t) * f(i) + t * f(i + 1)) * (g(j + 1) - g(j)), 1e-6);
    ASSERT_TRUE(surface_at(surface, j, i + t, 254, p)) << j << ' ' << i;
    EXPECT_NEAR(p.z_m, f(j) * ((1 - t) * g(i) + t * g(i + 1)), 1e-6);
    EXPECT_NEAR(p.slope_y * kRow_m, f(j) * (g(i + 1) - g(i)), 1e-6);
    EXPECT_NEAR(p.slope_x * kColumn_m, (f(j + 1) - f(j)) * ((1 - t) * g(i) + t * g(i + 1)), 1e-6);
  };
  for (const double t : {0.25, 0.75}) {
    expect_straight(-kOutermost, t, 4);
    expect_straight(last + kOutermost - 1, t, 4);
  }
  // The surface is bilinear between four pixels.
  ASSERT_TRUE(surface_at(surface, -kOutermost + 0.25, 4.75, 254, p));
  const double x0 = f(-kOutermost), x1 = f(-kOutermost + 1);
  EXPECT_NEAR(p.z_m, (0.75 * x0 + 0.25 * x1) * (0.25 * g(4) + 0.75 * g(5)), 1e-6);
  EXPECT_NEAR(p.slope_x * kColumn_m, (x1 - x0) * (0.25 * g(4) + 0.75 * g(5)), 1e-6);
  EXPECT_NEAR(p.slope_y * kRow_m, (0.75 * x0 + 0.25 * x1) * (g(5) - g(4)), 1e-6);
  // There is no pixel after the last one, so the slope is 0.
  ASSERT_TRUE(surface_at(surface, last + kOutermost, 4, 254, p));
  EXPECT_NEAR(p.z_m, f(last + kOutermost) * g(4), 1e-6);
  EXPECT_EQ(p.slope_x, 0);
  ASSERT_TRUE(surface_at(surface, 4, last + kOutermost, 254, p));
  EXPECT_NEAR(p.z_m, f(4) * g(last + kOutermost), 1e-6);
  EXPECT_EQ(p.slope_y, 0);
  EXPECT_FALSE(surface_at(surface, last + kOutermost + 0.1, 4, 254, p));
  EXPECT_FALSE(surface_at(surface, -kOutermost - 0.1, 4, 254, p));
  EXPECT_FALSE(surface_at(surface, -kOutermost - 0.1, 4, 300, p));
}

// A disc of a paraboloid: the line extends the heights beyond the edge, but it changes no height
// between measured pixels.
TEST(SurfaceEdges, MeasuredHeightsDoNotDependOnTheExtension) {
  const auto z = [](double i, double j) { return 0.3 * i * i - 0.2 * j * j + 0.1 * i * j + i; };
  const auto map = map_in_pixels(25, 25, [&](double i, double j) {
    return std::pow(i - 12, 2) + std::pow(j - 12, 2) > 121 ? SurfaceMap::kMissing : z(i, j);
  });
  const Surface surface(map, 3, Extension::line);
  std::size_t measured = 0;
  for (double i = 0; i <= 24; i += 0.1)
    for (double j = 0; j <= 24; j += 0.1) {
      SurfacePoint p;
      if (!surface_at(surface, i, j, 0, p)) continue;
      ++measured;
      ASSERT_NEAR(p.z_m, z(i, j), 1e-10) << i << ' ' << j;
      ASSERT_NEAR(p.slope_x * kColumn_m, 0.6 * i + 0.1 * j + 1, 1e-9) << i << ' ' << j;
      ASSERT_NEAR(p.slope_y * kRow_m, -0.4 * j + 0.1 * i, 1e-9) << i << ' ' << j;
    }
  EXPECT_GT(measured, 30'000u);
}

// Height and slopes do not jump where the path leaves the measured pixels.
TEST(SurfaceEdges, AreContinuous) {
  const auto map = map_in_pixels(25, 25, [](double i, double j) {
    return std::pow(i - 12, 2) + std::pow(j - 12, 2) > 121
               ? SurfaceMap::kMissing
               : std::sin(i / 3) * std::cos(j / 4) - 0.02 * i * i;
  });
  const Surface surface(map, 3, Extension::line);
  constexpr double kStep = 1e-7;
  for (double i = 1; i <= 23; i += 1)
    for (double j = 1.03; j <= 23; j += 0.1)
      for (const bool along_x : {true, false}) {
        SurfacePoint before, after;
        const double di = along_x ? kStep : 0, dj = along_x ? 0 : kStep;
        const double x = along_x ? i : j, y = along_x ? j : i;
        if (!surface_at(surface, x - di, y - dj, 3, before) ||
            !surface_at(surface, x + di, y + dj, 3, after))
          continue;
        ASSERT_NEAR(before.z_m, after.z_m, 1e-5) << x << ' ' << y;
        ASSERT_NEAR(before.slope_x * kColumn_m, after.slope_x * kColumn_m, 1e-5) << x << ' ' << y;
        ASSERT_NEAR(before.slope_y * kRow_m, after.slope_y * kRow_m, 1e-5) << x << ' ' << y;
      }
}

}  // namespace
}  // namespace mdof::algo
