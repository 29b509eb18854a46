// Scattered heights of a scan -> a height map.
#pragma once

#include <vector>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct ScanPoints {
  std::vector<double> x_m, y_m, z_m;
};

struct ScanMap {
  SurfaceMap map;
  // Standard uncertainty of each height by noise that differs from point to point, which the
  // scatter about the parabolas shows; without noise that neighbours have in common.
  SurfaceMap u;
  double noise_m = 0;  // standard deviation of one point
};

// The height of a pixel is that of a parabola z(x, y) fitted by least squares to the points around
// it, as many as determine it: within 1.5 to 6 pixels. A pixel with points on one side only has
// none. Points are averaged before over quarters of a pixel. Pixels stand at whole multiples of
// `pixel_m` from (0, 0); the outermost rows and columns have heights. Error: no pixel has a height;
// more pixels than a map may have.
Result<ScanMap> scan_map(const ScanPoints& points, double pixel_m);

}  // namespace mdof::algo
