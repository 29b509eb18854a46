// A measured surface: heights on a grid of pixels. Some heights may be missing.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "schema/notice/notice.h"

namespace mdof {

struct SurfaceMap {
  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

  std::string name;            // name of the file or run, for messages
  double x0_m = 0, y0_m = 0;   // position of the pixel (0, 0)
  double dx_m = 0, dy_m = 0;   // pixel size, above 0
  std::size_t nx = 0, ny = 0;  // columns along x, rows along y
  std::vector<double> z_m;     // nx ny values, row by row; kMissing: not measured
  Notices notices;             // assumptions that were made when the map was read

  double x_m(std::size_t column) const { return x0_m + static_cast<double>(column) * dx_m; }
  double y_m(std::size_t row) const { return y0_m + static_cast<double>(row) * dy_m; }
  double at(std::size_t column, std::size_t row) const { return z_m[row * nx + column]; }
  std::size_t measured() const {
    std::size_t count = 0;
    for (const double z : z_m) count += std::isnan(z) ? 0 : 1;
    return count;
  }
};

// Returns a map with the same pixels and without heights.
inline SurfaceMap empty_like(const SurfaceMap& map) {
  SurfaceMap empty{map.name, map.x0_m, map.y0_m, map.dx_m, map.dy_m, map.nx, map.ny, {}, {}};
  empty.z_m.assign(map.z_m.size(), SurfaceMap::kMissing);
  return empty;
}

// Largest number of pixels of a map. All pixels are in memory at once.
inline constexpr std::size_t kMostPixels = 50'000'000;

}  // namespace mdof
