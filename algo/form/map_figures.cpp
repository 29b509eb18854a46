#include "algo/form/map_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {

MapFigures figures_of(const SurfaceMap& map) {
  MapFigures figures;
  double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;
  for (const double z : map.z_m) {
    if (std::isnan(z)) continue;
    least = std::min(least, z);
    most = std::max(most, z);
    sum += z;
    ++figures.pixels;
  }
  if (figures.pixels == 0) return figures;
  const auto n = static_cast<double>(figures.pixels);
  figures.pv_m = most - least;
  figures.mean_m = sum / n;
  double squares = 0;
  for (const double z : map.z_m)
    if (!std::isnan(z)) squares += (z - figures.mean_m) * (z - figures.mean_m);
  figures.rms_m = std::sqrt(squares / n);
  return figures;
}

Plane plane_of(const SurfaceMap& map) {
  Plane plane;
  double n = 0, sum_x = 0, sum_y = 0, sum_z = 0;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (const double z = map.at(i, j); !std::isnan(z)) {
        n += 1;
        sum_x += map.x_m(i);
        sum_y += map.y_m(j);
        sum_z += z;
      }
  if (n == 0) return plane;
  plane.x_mean_m = sum_x / n;
  plane.y_mean_m = sum_y / n;
  plane.piston_m = sum_z / n;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2, 2);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(2);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (const double z = map.at(i, j); !std::isnan(z)) {
        const double x = map.x_m(i) - plane.x_mean_m, y = map.y_m(j) - plane.y_mean_m;
        A(0, 0) += x * x;
        A(0, 1) += x * y;
        A(1, 1) += y * y;
        b(0) += x * (z - plane.piston_m);
        b(1) += y * (z - plane.piston_m);
      }
  A(1, 0) = A(0, 1);
  if (!(A(0, 0) + A(1, 1) > 0)) return plane;  // one pixel
  const Eigen::VectorXd tilt = LeastNorm(A, 1e-12).solve(b);
  plane.tilt_x = tilt(0);
  plane.tilt_y = tilt(1);
  return plane;
}

void remove_plane(SurfaceMap& map) {
  const Plane plane = plane_of(map);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      map.z_m[j * map.nx + i] -= plane.at(map.x_m(i), map.y_m(j));
}

}  // namespace mdof::algo
