// The plane between two maps for places that are mostly near one corner, so that no sum of their
// coordinates vanishes.
#include "algo/form/pose/pose_fit.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/algo/form/known_maps.h"

namespace mdof::algo {
namespace {

// A block of pixels at one corner and the three other corner pixels.
SurfaceMap map_of_a_corner(const std::function<double(double, double)>& z) {
  SurfaceMap map = map_of(z, 2e-3, -1e-3, 0.5e-3, 25, 21);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      const bool in_block = i < 9 && j < 7;
      const bool at_corner = (i == 0 || i + 1 == map.nx) && (j == 0 || j + 1 == map.ny);
      if (!in_block && !at_corner) map.z_m[j * map.nx + i] = SurfaceMap::kMissing;
    }
  return map;
}

Surface whole_surface(const std::function<double(double, double)>& z) {
  return Surface(map_of(z, 0, -3e-3, 0.5e-3, 40, 40), 0, Extension::parabola);
}

double smooth_form(double x, double y) {
  return 1e-6 * std::sin(x / 5e-3 + 0.3) * std::cos(y / 4e-3);
}

// z = p + q x' + r y' with x' and y' relative to the middle of the places, in units of their size.
TEST(PlaneOfAPose, IsExactForAnyPlaces) {
  const Places a = places_of(map_of_a_corner(smooth_form), 10'000);
  ASSERT_EQ(a.z_m.size(), 9u * 7u + 3u);
  EXPECT_NEAR(a.x_mid_m, 8e-3, 1e-15);
  EXPECT_NEAR(a.y_mid_m, 4e-3, 1e-15);
  EXPECT_NEAR(a.size_m, 12.5e-3, 1e-15);
  const double p = 3e-6, q = 5e-6, r = -7e-6;
  const Surface b = whole_surface([&](double x, double y) {
    return smooth_form(x, y) + p + q * (x - a.x_mid_m) / a.size_m + r * (y - a.y_mid_m) / a.size_m;
  });
  const PoseFit fit = plane_fit_at_pose(a, b, {});
  EXPECT_EQ(fit.count, 66);
  EXPECT_NEAR(fit.plane[0], p, 1e-13);
  EXPECT_NEAR(fit.plane[1], q, 1e-13);
  EXPECT_NEAR(fit.plane[2], r, 1e-13);
  for (const double left : fit.left_m) EXPECT_NEAR(left, 0, 1e-13);
}

// Large residuals have the weight limit / |residual|. The weighted sums of the residuals and of
// their products with x and y vanish, and the limit is 1.345 · 1.4826 times the median of the
// absolute residuals (Huber).
TEST(PlaneOfAPose, FulfilsTheEquationsOfHuber) {
  SurfaceMap map = map_of_a_corner(smooth_form);
  std::uint32_t state = 1;
  for (double& z : map.z_m) {
    state = state * 1664525u + 1013904223u;
    z += 2e-8 * (state / 4294967296.0 - 0.5);
  }
  map.z_m[0] += 1e-6;
  map.z_m[3 * map.nx + 5] -= 0.7e-6;
  const Places a = places_of(map, 10'000);
  const PoseFit fit = plane_fit_at_pose(a, whole_surface(smooth_form), {});
  std::vector<double> sizes;
  double sum = 0, sum_x = 0, sum_y = 0, all = 0;
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    const double left = fit.left_m[k], size = std::abs(left);
    const double weighted = left * std::min(1.0, fit.limit_m / size);
    sizes.push_back(size);
    sum += weighted;
    sum_x += weighted * a.x_m[k] / a.size_m;
    sum_y += weighted * a.y_m[k] / a.size_m;
    all += std::abs(weighted);
    const double plane =
        fit.plane[0] + (fit.plane[1] * a.x_m[k] + fit.plane[2] * a.y_m[k]) / a.size_m;
    EXPECT_NEAR(left, smooth_form(a.x_m[k] + a.x_mid_m, a.y_m[k] + a.y_mid_m) - a.z_m[k] - plane,
                1e-11);
  }
  for (const double each : {sum, sum_x, sum_y}) EXPECT_NEAR(each / all, 0, 1e-5);
  std::sort(sizes.begin(), sizes.end());
  EXPECT_NEAR(fit.limit_m / (1.345 * 1.4826 * sizes[sizes.size() / 2]), 1, 1e-5);
  EXPECT_LT(fit.limit_m, 0.1e-6) << "the two outliers exceed the limit";
}

// The least-squares plane by the QR decomposition of Eigen. The pose shifts B by (3, -2) pixels.
TEST(PlaneOfAPose, MeanSquareIsThatOfTheLeastSquaresPlane) {
  const Places a = places_of(map_of_a_corner(smooth_form), 10'000);
  const Surface b =
      whole_surface([](double x, double y) { return 2 * smooth_form(x, y) + 1e-4 * x * x; });
  const MapPose pose{1.5e-3, -1e-3, 0};
  const auto n = static_cast<Eigen::Index>(a.z_m.size());
  Eigen::MatrixXd A(n, 3);
  Eigen::VectorXd z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double x = a.x_m[at] + a.x_mid_m + pose.shift_x_m,
                 y = a.y_m[at] + a.y_mid_m + pose.shift_y_m;
    A.row(k) << 1, a.x_m[at] * 1e3, a.y_m[at] * 1e3;
    z(k) = 2 * smooth_form(x, y) + 1e-4 * x * x - a.z_m[at];
  }
  const Eigen::VectorXd left = z - A * A.colPivHouseholderQr().solve(z);
  const double expected = left.squaredNorm() / static_cast<double>(n);
  EXPECT_NEAR(mean_square_at(a, b, pose, 1) / expected, 1, 1e-9);
  // At a shift of 12 mm, B has no counterpart for the two corners on the right.
  const MapPose far{7e-3, 0, 0};
  EXPECT_LT(mean_square_at(a, b, far, 1), 0);
  EXPECT_LT(mean_square_at(a, b, far, 64.5 / 66), 0);
  EXPECT_GT(mean_square_at(a, b, far, 63.5 / 66), 0);
  EXPECT_LT(mean_square_at(a, b, {1, 1, 0}, 0), 0);
}

TEST(PlaneOfAPose, MeanResidualIsOverTheChosenPlaces) {
  PoseFit fit;
  fit.left_m = {3, -5, SurfaceMap::kMissing, 40, 7};
  const MeanLeft mean = mean_left(fit, {true, true, true, true, false}, 10);
  EXPECT_NEAR(mean.size_m, (3 + 5 + 10) / 3.0, 1e-15);
  EXPECT_NEAR(mean.share, 0.6, 1e-15);
  const MeanLeft none = mean_left(fit, {false, false, true, false, false}, 10);
  EXPECT_EQ(none.size_m, 0);
  EXPECT_EQ(none.share, 0);
}

}  // namespace
}  // namespace mdof::algo
