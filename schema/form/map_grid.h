// Points in any order -> the grid that they lie on.
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
  std::vector<double> x_m, y_m, z_m;  // z: SurfaceMap::kMissing where it has none
};

// The points may miss pixels, whole rows and columns too; their places may be rounded by up to a
// twentieth of a pixel. `place(k)` is where the point k comes from ("map.csv:7: "). Errors: points
// on no grid, two points on one pixel, a single place, no height at all.
Result<SurfaceMap> grid_of(const MapPoints& points, const std::string& source,
                           const std::function<std::string(std::size_t)>& place);

}  // namespace mdof
