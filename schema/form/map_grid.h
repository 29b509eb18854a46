// Finds the grid of points. The points may be in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof {

// Limits of coordinates, heights and pixel sizes. Larger values do not occur on parts; usually
// their unit is wrong.
inline constexpr double kFarthest_m = 1e3, kLargestPixel_m = 0.1;

struct MapPoints {
  std::vector<double> x_m, y_m, z_m;  // z: SurfaceMap::kMissing if there is no height
};

// Pixels and complete rows and columns may be missing. Positions may differ from the grid by up to
// a twentieth of a pixel because of rounding. `place(k)` returns the file and line of point k for
// messages ("map.csv:7: "). Errors: points that are not on a grid; two points on one pixel; all
// points at one position; a map without heights.
Result<SurfaceMap> grid_of(const MapPoints& points, const std::string& source,
                           const std::function<std::string(std::size_t)>& place);

}  // namespace mdof
