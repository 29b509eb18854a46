// Finds the grid of points that are in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof {

struct MapPoints {
  std::vector<double> x_m, y_m, z_m;  // z: SurfaceMap::kMissing if there is no height
};

// Pixels, whole rows and columns may be missing, and positions may be rounded by up to a twentieth
// of a pixel. `place(k)` is the origin of point k ("map.csv:7: "). Errors: points that are on no
// grid, two points on one pixel, a single position, no height at all.
Result<SurfaceMap> grid_of(const MapPoints& points, const std::string& source,
                           const std::function<std::string(std::size_t)>& place);

}  // namespace mdof
