#include "algo/form/map_figures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kSpeckShare = 100;  // the largest region has more pixels by this factor

// Marks the pixels of the region of the pixel `first`. Returns their number.
std::size_t mark_region(const SurfaceMap& map, std::size_t first, std::vector<std::uint8_t>& marks,
                        std::uint8_t mark) {
  std::vector<std::size_t> pending{first};
  std::size_t pixels = 0;
  const std::uint8_t before = marks[first];
  marks[first] = mark;
  while (!pending.empty()) {
    const std::size_t i = pending.back() % map.nx, j = pending.back() / map.nx;
    pending.pop_back();
    ++pixels;
    for (std::size_t v = j > 0 ? j - 1 : 0; v <= std::min(j + 1, map.ny - 1); ++v)
      for (std::size_t u = i > 0 ? i - 1 : 0; u <= std::min(i + 1, map.nx - 1); ++u) {
        const std::size_t k = v * map.nx + u;
        if (marks[k] != before || std::isnan(map.z_m[k])) continue;
        marks[k] = mark;
        pending.push_back(k);
      }
  }
  return pixels;
}

}  // namespace

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

MeasuredExtent measured_extent(const SurfaceMap& map) {
  MeasuredExtent extent{map.nx, 0, map.ny, 0};
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      if (std::isnan(map.at(i, j))) continue;
      extent.left = std::min(extent.left, i);
      extent.right = std::max(extent.right, i);
      extent.low = std::min(extent.low, j);
      extent.high = j;
    }
  assert(extent.left <= extent.right);
  return extent;
}

void remove_plane(SurfaceMap& map) {
  const Plane plane = plane_of(map);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      map.z_m[j * map.nx + i] -= plane.at(map.x_m(i), map.y_m(j));
}

SurfaceMap without_specks(SurfaceMap map, std::size_t& removed) {
  constexpr std::uint8_t kNew = 0, kFound = 1, kSpeck = 2;
  struct Region {
    std::size_t first = 0, pixels = 0;
  };
  std::vector<std::uint8_t> marks(map.z_m.size(), kNew);
  std::vector<Region> regions;
  std::size_t most = 0;
  for (std::size_t k = 0; k < map.z_m.size(); ++k) {
    if (marks[k] != kNew || std::isnan(map.z_m[k])) continue;
    regions.push_back({k, mark_region(map, k, marks, kFound)});
    most = std::max(most, regions.back().pixels);
  }
  for (const Region& region : regions) {
    if (region.pixels * kSpeckShare >= most) continue;
    removed += mark_region(map, region.first, marks, kSpeck);
  }
  for (std::size_t k = 0; k < map.z_m.size(); ++k)
    if (marks[k] == kSpeck) map.z_m[k] = SurfaceMap::kMissing;
  return map;
}

}  // namespace mdof::algo
