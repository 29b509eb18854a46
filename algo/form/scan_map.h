// Calculates a height map from the scattered heights of a scan.
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
  // Standard uncertainty of each height by noise that is independent from point to point, from the
  // scatter about the parabolas. It does not include noise that neighbours have in common.
  SurfaceMap u;
  double noise_m = 0;  // standard deviation of one point
};

// The height of a pixel is that of a parabola z(x, y) fitted by least squares to the points around
// it. The radius is 1.5 to 6 pixels, the smallest that determines the parabola. A pixel with points
// on one side only has no height. Points are first averaged over quarters of a pixel. Pixels are at
// integer multiples of `pixel_m` from (0, 0); the outermost rows and columns have heights. Error:
// no pixel has a height; more pixels than the limit of a map.
Result<ScanMap> scan_map(const ScanPoints& points, double pixel_m);

}  // namespace mdof::algo
