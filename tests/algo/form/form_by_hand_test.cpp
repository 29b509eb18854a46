// Results for small maps that are calculated by hand: planes, passes, parts of a clamping, stress,
// harmonics.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "algo/form/clamping.h"
#include "algo/form/cutting.h"
#include "algo/form/map_figures.h"
#include "algo/form/spiral_path.h"
#include "algo/form/turn_spectrum.h"

namespace mdof::algo {
namespace {

constexpr double kHole = SurfaceMap::kMissing;

// A map with columns every 2 m from x = 10 m on, and rows every 3 m from y = -1 m on.
SurfaceMap small_map(std::size_t nx, std::size_t ny, std::vector<double> z) {
  return {"small", 10, -1, 2, 3, nx, ny, std::move(z), {}};
}

TEST(MapFiguresByHand, MatchForFourOneAndNoPixels) {
  const MapFigures found = algo::figures_of(small_map(3, 2, {1, kHole, 4, -3, kHole, 6}));
  EXPECT_EQ(found.pixels, 4u);
  EXPECT_EQ(found.pv_m, 9);
  EXPECT_EQ(found.mean_m, 2);
  EXPECT_NEAR(found.rms_m, std::sqrt((1 + 4 + 25 + 16) / 4.0), 1e-15);
  const MapFigures one = algo::figures_of(small_map(1, 1, {7}));
  EXPECT_EQ(one.pixels, 1u);
  EXPECT_EQ(one.mean_m, 7);
  EXPECT_EQ(one.pv_m, 0);
  EXPECT_EQ(one.rms_m, 0);
  const MapFigures none = algo::figures_of(small_map(2, 1, {kHole, kHole}));
  EXPECT_EQ(none.pixels, 0u);
  EXPECT_EQ(none.pv_m, 0);
  EXPECT_EQ(none.rms_m, 0);
  EXPECT_EQ(none.mean_m, 0);
}

// Three pixels determine a plane. It is 5 at (10, -1), 6 at the next column (2 m further) and 11 at
// the next row (3 m further).
TEST(PlaneByHand, PassesThroughThreePixels) {
  SurfaceMap map = small_map(2, 2, {5, 6, 11, kHole});
  const Plane plane = plane_of(map);
  EXPECT_NEAR(plane.tilt_x, 0.5, 1e-12);
  EXPECT_NEAR(plane.tilt_y, 2, 1e-12);
  EXPECT_NEAR(plane.x_mean_m, 10 + 2 / 3.0, 1e-12);
  EXPECT_NEAR(plane.y_mean_m, -1 + 1, 1e-12);
  EXPECT_NEAR(plane.piston_m, 22 / 3.0, 1e-12);
  EXPECT_NEAR(plane.at(12, 2), 12, 1e-12);
  remove_plane(map);
  for (const std::size_t k : {0u, 1u, 2u}) EXPECT_NEAR(map.z_m[k], 0, 1e-12);
  EXPECT_TRUE(std::isnan(map.z_m[3]));
}

// The plane is the least-squares plane of four corners, so the residuals have alternating signs.
TEST(PlaneByHand, FourPixelsGiveTheLeastSquaresPlane) {
  SurfaceMap map = small_map(2, 2, {1, 0, 0, 3});
  const Plane plane = plane_of(map);
  EXPECT_NEAR(plane.piston_m, 1, 1e-12);
  EXPECT_NEAR(plane.tilt_x, (3 - 1) / 2.0 / 2, 1e-12);
  EXPECT_NEAR(plane.tilt_y, (3 - 1) / 2.0 / 3, 1e-12);
  remove_plane(map);
  EXPECT_NEAR(map.z_m[0], 1, 1e-12);
  EXPECT_NEAR(map.z_m[1], -1, 1e-12);
}

// If the pixels do not determine a tilt, this tilt is 0.
TEST(PlaneByHand, UndeterminedTiltsAreZero) {
  const Plane row = plane_of(small_map(3, 1, {1, 2, 6}));
  EXPECT_NEAR(row.tilt_x, 5 / 4.0, 1e-12);
  EXPECT_NEAR(row.tilt_y, 0, 1e-12);
  const Plane column = plane_of(small_map(1, 3, {1, 2, 6}));
  EXPECT_NEAR(column.tilt_x, 0, 1e-12);
  EXPECT_NEAR(column.tilt_y, 5 / 6.0, 1e-12);
  const Plane pixel = plane_of(small_map(2, 1, {kHole, 8}));
  EXPECT_EQ(pixel.at(100, 200), 8);
  EXPECT_EQ(pixel.tilt_x, 0);
  const Plane none = plane_of(small_map(2, 1, {kHole, kHole}));
  EXPECT_EQ(none.at(100, 200), 0);
  EXPECT_EQ(none.x_mean_m, 0);
  EXPECT_EQ(none.y_mean_m, 0);
}

// The measured pixels are in columns 1 to 3 and rows 1 to 2.
TEST(ReachByHand, MiddleAndFarthestMeasuredPixel) {
  std::vector<double> z(4 * 5, kHole);
  z[1 * 4 + 3] = z[2 * 4 + 1] = 0;
  const SurfaceMap map = small_map(4, 5, z);
  const MapMiddle middle = algo::middle_of(map);
  EXPECT_EQ(middle.x_m, 10 + 2 * 2);
  EXPECT_EQ(middle.y_m, -1 + 1.5 * 3);
  // The mean of the pixels (16, 2), (12, 5) and (14, 2).
  z[1 * 4 + 2] = 0;
  const MapMiddle mean = algo::mean_pixel(small_map(4, 5, z));
  EXPECT_EQ(mean.x_m, 14);
  EXPECT_EQ(mean.y_m, 3);
  // The distances of the pixels (16, 2) and (12, 5) from (13, 1) are (3, 1) and (1, 4).
  const FarthestPixel far = farthest_pixel(map, 13, 1);
  EXPECT_NEAR(far.radius_m, std::sqrt(17), 1e-12);
  EXPECT_EQ(far.x_m, 12);
  EXPECT_EQ(far.y_m, 5);
  EXPECT_NEAR(farthest_pixel(map, 12, 5).radius_m, 5, 1e-12);
  EXPECT_EQ(farthest_pixel(small_map(1, 1, {kHole}), 0, 0).radius_m, 0);
  // The measured pixels of a map without holes are the whole map.
  const SurfaceMap whole = small_map(3, 2, std::vector<double>(6, 0.0));
  EXPECT_EQ(algo::middle_of(whole).x_m, 12);
  EXPECT_EQ(algo::middle_of(whole).y_m, 0.5);
  EXPECT_NEAR(farthest_pixel(whole, 10, -1).radius_m, 5, 1e-12);
}

// Grooves with the radius 5 at a distance of 6 are 1 deep. With a radius of 3 or less, the depth
// equals the radius.
TEST(FeedRoughnessByHand, DepthOfGroovesMatchesTheArc) {
  EXPECT_NEAR(feed_roughness(5, 6).Rt_m, 1, 1e-12);
  EXPECT_NEAR(feed_roughness(5, 6).Ra_m, 4 / (9 * std::sqrt(3)), 1e-12);
  EXPECT_EQ(feed_roughness(3, 6).Rt_m, 3);
  EXPECT_EQ(feed_roughness(3, 6).Ra_m, 3);
  EXPECT_EQ(feed_roughness(2, 6).Rt_m, 2);
}

// The discrete Fourier transform by its definition.
std::vector<std::complex<double>> transformed(const std::vector<std::complex<double>>& x,
                                              double sign) {
  std::vector<std::complex<double>> X(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t j = 0; j < x.size(); ++j)
      X[k] += x[j] *
              std::polar(1.0, sign * 2 * std::numbers::pi * static_cast<double>(j * k % x.size()) /
                                  static_cast<double>(x.size()));
  return X;
}
TEST(DftByDefinition, MatchesForAllLengthsUpToSixty) {
  for (std::size_t n = 1; n <= 60; ++n) {
    std::vector<std::complex<double>> x;
    for (std::size_t k = 0; k < n; ++k)
      x.emplace_back(std::sin(1.7 * static_cast<double>(k * k)),
                     std::cos(2.3 * static_cast<double>(k)));
    for (const bool inverse : {false, true}) {
      std::vector<std::complex<double>> found = x;
      Dft(n).transform(found, inverse);
      const auto expected = transformed(x, inverse ? 1 : -1);
      for (std::size_t k = 0; k < n; ++k)
        ASSERT_LT(std::abs(found[k] - expected[k]), 1e-11) << n << ' ' << k;
    }
  }
}

// Passes over 2 x 2 pixels; the wanted height is 0.
CuttingPasses make_cutting_passes(std::vector<std::vector<double>> cuts, bool repeated,
                                  CuttingGain gain) {
  CuttingPasses passes{small_map(2, 2, {0, 0, 0, 0}), {}, repeated, gain};
  for (std::vector<double>& cut : cuts) passes.cuts.push_back(small_map(2, 2, std::move(cut)));
  return passes;
}

// The means 3, -3, 0, 0 of the two passes have the mean square 18/4. At each of the four pixels the
// passes differ by 2, so the variance of one pass is 8/4.
TEST(CuttingByHand, TwoRepeatedPassesGiveTheExpectedShares) {
  const auto found =
      next_cut(make_cutting_passes({{2, -2, 1, -1}, {4, -4, -1, 1}}, true, CuttingGain::one));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->error[0].rms_m, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(found->error[1].rms_m, std::sqrt(8.5), 1e-12);
  EXPECT_NEAR(*found->random_rms_m, std::sqrt(2), 1e-12);
  EXPECT_NEAR(*found->repeatable_rms_m, std::sqrt(4.5 - 2 / 2.0), 1e-12);
  EXPECT_NEAR(*found->floor_gain_one_m, 2, 1e-12);
  EXPECT_NEAR(*found->floor_mean_m, std::sqrt(3), 1e-12);
  EXPECT_TRUE(*found->converges);  // the floor is 2, the error sqrt(5.5)
  EXPECT_NEAR(found->next.z_m[0], -4, 1e-12);
  EXPECT_NEAR(found->next.z_m[2], 1, 1e-12);
  // A mean height (piston) of one pass does not change the random share.
  const auto raised =
      next_cut(make_cutting_passes({{7, 3, 6, 4}, {4, -4, -1, 1}}, true, CuttingGain::mean));
  EXPECT_NEAR(*raised->random_rms_m, std::sqrt(2), 1e-12);
  EXPECT_NEAR(raised->next.z_m[0], -(7 + 4) / 2.0, 1e-12);
  EXPECT_NEAR(raised->error[0].mean_m, 5, 1e-12);
}

// The passes 1, -1, 1, -1 and 4, -4, -1, 1 have the random variance 13/4. The mean square of the
// errors is 4.75. The floor is sqrt(6.5) for gain 1 and sqrt(4.875) for the mean.
TEST(CuttingByHand, PassesAtTheirFloorDoNotConverge) {
  for (const CuttingGain gain : {CuttingGain::one, CuttingGain::mean}) {
    const auto found = next_cut(make_cutting_passes({{1, -1, 1, -1}, {4, -4, -1, 1}}, true, gain));
    EXPECT_NEAR(*found->floor_mean_m, std::sqrt(4.875), 1e-12);
    EXPECT_FALSE(*found->converges);
  }
  // The repeatable share is larger. The mean square of the errors is 6.125, between the squares of
  // both floors.
  const auto by = [](CuttingGain gain) {
    return *next_cut(make_cutting_passes({{1.5, -1.5, 1, -1}, {4.5, -4.5, -1, 1}}, true, gain))
                ->converges;
  };
  EXPECT_TRUE(by(CuttingGain::mean));
  EXPECT_FALSE(by(CuttingGain::one));
}

// Each pass is cut with the path that the pass before determined. The errors of the three passes
// are 4, 2 and 3 times (1, -1, 1, -1). The errors minus the paths are 4, 6 and 9 times this form
// with gain 1, and 4, 6 and 8 times with the mean.
TEST(CuttingByHand, SuccessivePassesGiveTheExpectedPath) {
  const std::vector<std::vector<double>> cuts = {{4, -4, 4, -4}, {2, -2, 2, -2}, {3, -3, 3, -3}};
  const auto one = next_cut(make_cutting_passes(cuts, false, CuttingGain::one));
  EXPECT_NEAR(one->next.z_m[0], -9, 1e-12);
  EXPECT_NEAR(*one->repeatable_rms_m,
              std::sqrt(19 * 19 / 9.0 - (16 + 36 + 81 - 19 * 19 / 3.0) / 2 / 3), 1e-12);
  const auto mean = next_cut(make_cutting_passes(cuts, false, CuttingGain::mean));
  EXPECT_NEAR(mean->next.z_m[0], -6, 1e-12);
  EXPECT_NEAR(*mean->random_rms_m, 2, 1e-12);
  EXPECT_NEAR(*mean->floor_mean_m, 2 * std::sqrt(4 / 3.0), 1e-12);
}

// The passes converge if the last error is smaller than the first, and at most 1.5 times the
// smallest error after the first.
TEST(CuttingByHand, ConvergesWhileErrorsStayNearTheSmallest) {
  const auto of = [](const std::vector<double>& sizes) {
    std::vector<std::vector<double>> cuts;
    for (const double s : sizes) cuts.push_back({s, -s, s, -s});
    return *next_cut(make_cutting_passes(cuts, false, CuttingGain::one))->converges;
  };
  EXPECT_TRUE(of({4, 3.5}));
  EXPECT_FALSE(of({4, 4}));
  EXPECT_TRUE(of({4, 2, 3}));
  EXPECT_FALSE(of({4, 2, 3.25}));
  EXPECT_FALSE(of({4, 2, 5}));
  EXPECT_FALSE(of({8, 3, 2, 3.25}));
  EXPECT_TRUE(of({8, 3, 2, 3}));
}

TEST(CuttingByHand, PixelsMissingInAnyMapAreLeftOut) {
  const auto found =
      next_cut(make_cutting_passes({{2, -2, kHole, 5}, {4, -4, 7, 5}}, true, CuttingGain::one));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pixels, 3u);
  EXPECT_EQ(found->error[1].pixels, 3u);
  EXPECT_TRUE(std::isnan(found->next.z_m[2]));
  // Minus the mean of 5/3, the cuts are 1/3, -11/3, 10/3 and 7/3, -17/3, 10/3. Half of their
  // differences are 1, 1 and 0.
  EXPECT_NEAR(*found->random_rms_m, std::sqrt((2 + 2) / 3.0), 1e-12);
  EXPECT_FALSE(next_cut(
      make_cutting_passes({{2, -2, kHole, kHole}, {kHole, 4, -4, 5}}, true, CuttingGain::one)));
  EXPECT_TRUE(next_cut(
      make_cutting_passes({{2, -2, 3, kHole}, {kHole, 4, -4, 5}}, true, CuttingGain::one)));
}

// All parts are calculated over the common pixels. The saddle s = 1, -1, -1, 1 at the corners
// contains no plane. The clamped form is 3 s and a plane, the released form is 1 s.
TEST(ClampingByHand, SaddleGivesPartsAndK) {
  const auto saddle = [](double size, double piston, double tilt) {
    std::vector<double> z;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        z.push_back(size * (2 * i - 3) * (2 * j - 3) + piston + tilt * (i + 2 * j));
    return small_map(4, 4, z);
  };
  SurfaceMap before = saddle(0, 1, 0), after = saddle(3, 2, 0.5), released = saddle(1, 4, -1);
  const auto found = clamping_by_release(before, after, released);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->K, 0.5, 1e-12);
  EXPECT_NEAR(*found->K_unexplained_rms_m, 0, 1e-12);
  EXPECT_NEAR(found->clamping.z_m[0], 27, 1e-11);
  EXPECT_NEAR(found->plastic.z_m[0], 9, 1e-11);
  EXPECT_NEAR(found->elastic.z_m[0], 18, 1e-11);
  const auto by_K = clamping_by_K(before, after, 0.5);
  EXPECT_NEAR(by_K->clamping.z_m[0], 27, 1e-11);
  EXPECT_NEAR(by_K->elastic.z_m[0], 18, 1e-11);
  EXPECT_NEAR(by_K->plastic.z_m[0], 9, 1e-11);
  EXPECT_EQ(by_K->K, 0.5);
  EXPECT_FALSE(by_K->K_unexplained_rms_m.has_value());
  EXPECT_TRUE(clamping_by_K(before, after, -0.999));
  EXPECT_FALSE(clamping_by_K(before, after, INFINITY));
  EXPECT_FALSE(clamping_by_K(before, after, NAN));
  // A different pixel is missing in each of two maps. Both pixels are missing in all parts.
  after.z_m[3] = released.z_m[12] = kHole;
  const auto holes = clamping_by_release(before, after, released);
  ASSERT_TRUE(holes) << holes.error().message;
  EXPECT_NEAR(holes->K, 0.5, 1e-12);
  for (const SurfaceMap* part : {&holes->clamping, &holes->elastic, &holes->plastic}) {
    EXPECT_EQ(part->measured(), 14u);
    EXPECT_TRUE(std::isnan(part->z_m[3]) && std::isnan(part->z_m[12]));
  }
  // Three common pixels are too few, four are enough.
  SurfaceMap few = after;
  for (std::size_t k = 0; k < 16; ++k)
    if (k != 0 && k != 2 && k != 8) few.z_m[k] = kHole;
  EXPECT_FALSE(clamping_by_release(before, few, saddle(1, 4, -1)));
  few.z_m[10] = after.z_m[10];
  EXPECT_TRUE(clamping_by_release(before, few, saddle(1, 4, -1)));
}

// The released form contains a wave that is orthogonal to the elastic part. K does not explain this
// wave.
TEST(ClampingByHand, ReportsThePartThatKDoesNotExplain) {
  std::vector<double> x_waves, y_waves;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const double along_x = i == 0 || i == 3 ? 1 : -1, along_y = j == 0 || j == 3 ? 1 : -1;
      x_waves.push_back(along_x);
      y_waves.push_back(along_y);
    }
  std::vector<double> after(16), released(16);
  for (std::size_t k = 0; k < 16; ++k) {
    released[k] = 0.5 * x_waves[k] + 3 * y_waves[k];
    after[k] = 2 * x_waves[k] + released[k];
  }
  const auto found = clamping_by_release(small_map(4, 4, std::vector<double>(16, 0.0)),
                                         small_map(4, 4, after), small_map(4, 4, released));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->K, 0.25, 1e-12);
  EXPECT_NEAR(*found->K_unexplained_rms_m, 3, 1e-12);
}

// Pixels of 0.5 mm by 0.8 mm. A parabola has the same curvature everywhere, also at edges and at
// holes.
TEST(PlateStressByHand, ParabolaOnOblongPixels) {
  const double xx = 0.02, yy = -0.05, xy = 0.03;
  const Plate plate{2e-3, 200e9, 0.3};
  SurfaceMap form{"form", -4e-3, 7e-3, 0.5e-3, 0.8e-3, 17, 13, {}, {}};
  for (std::size_t j = 0; j < form.ny; ++j)
    for (std::size_t i = 0; i < form.nx; ++i) {
      const double x = form.x_m(i), y = form.y_m(j);
      form.z_m.push_back(1e-6 + 2e-3 * x - 1e-3 * y + xx * x * x / 2 + yy * y * y / 2 + xy * x * y);
    }
  const double face = 200e9 * 2e-3 / 2;
  const double sx = face / (1 - 0.09) * (xx + 0.3 * yy), sy = face / (1 - 0.09) * (yy + 0.3 * xx),
               t = face / 1.3 * xy;
  const double mises = std::sqrt(sx * sx - sx * sy + sy * sy + 3 * t * t);
  for (const double side : {2e-3, 3e-3, 3.3e-3, 5e-3}) {
    const auto found = plate_stress(form, plate, side);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->max_Pa, mises, 1e-6 * mises) << side;
  }
  form.z_m[6 * 17 + 8] = form.z_m[7 * 17 + 8] = form.z_m[0] = kHole;
  const auto holes = plate_stress(form, plate, 5e-3);
  EXPECT_NEAR(holes->max_Pa, mises, 1e-6 * mises);
  // A square with a side of 1.6 mm contains one more row of 0.8 mm on each side. A smaller square
  // is refused.
  EXPECT_FALSE(plate_stress(form, plate, 1.59e-3));
  EXPECT_TRUE(plate_stress(form, plate, 1.61e-3));
}

// The curvature of x³ increases with x, so the largest stress is at the last column.
TEST(PlateStressByHand, LocatesTheLargestStress) {
  const auto growing = [](bool along_x, double sign) {
    SurfaceMap form{"form", 0, 0, 1e-3, 1e-3, 15, 15, {}, {}};
    for (std::size_t j = 0; j < 15; ++j)
      for (std::size_t i = 0; i < 15; ++i) {
        const double u = static_cast<double>(along_x ? i : j) * 1e-3 - 7e-3;
        form.z_m.push_back(sign * std::pow(u + 9e-3, 3));
      }
    return form;
  };
  const Plate plate{2e-3, 200e9, 0.3};
  for (const double sign : {1.0, -1.0}) {
    EXPECT_DOUBLE_EQ(plate_stress(growing(true, sign), plate, 4e-3)->x_m, 14e-3);
    EXPECT_DOUBLE_EQ(plate_stress(growing(false, sign), plate, 4e-3)->y_m, 14e-3);
  }
  // A flat plate has no stress.
  const auto flat = plate_stress(small_map(5, 5, std::vector<double>(25, 0.0)), plate, 7);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->max_Pa, 0);
  EXPECT_EQ(flat->x_m, 0);
  EXPECT_EQ(flat->y_m, 0);
}

// 3 x 3 pixels: only the square about the middle pixel determines a parabola. Two rows do not.
TEST(PlateStressByHand, NeedsThreeRowsAndColumns) {
  const Plate plate{2e-3, 200e9, 0.3};
  const auto of = [&](const std::vector<double>& z) {
    return plate_stress(small_map(3, 3, z), plate, 6);
  };
  const auto whole = of({1, 0, 1, 0, -1, 0, 1, 0, 1});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->pixels, 1u);
  EXPECT_EQ(whole->x_m, 12);
  EXPECT_EQ(whole->y_m, 2);
  EXPECT_FALSE(of({1, 0, 1, 0, -1, 0, kHole, kHole, kHole}));
  EXPECT_FALSE(of({1, 0, 1, 0, kHole, 0, 1, 0, 1}));
  // Seven of nine pixels are enough. The parabola is fitted to them by least squares.
  const auto seven = of({1, 0, kHole, 0, -1, 0, kHole, 0, 1});
  ASSERT_TRUE(seven);
  EXPECT_EQ(seven->pixels, 1u);
}

}  // namespace
}  // namespace mdof::algo
