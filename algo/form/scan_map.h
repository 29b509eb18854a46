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
  // Standard uncertainty of each height. It contains only noise that is independent from point to
  // point, and is calculated from the scatter about the parabolas.
  SurfaceMap u;
  double noise_m = 0;  // standard deviation of the noise of one point
};

// The height of a pixel is the height of a parabola z(x, y) that is fitted by least squares to the
// points around the pixel, within the smallest radius from 1.5 to 6 pixels that determines the
// parabola. A pixel with points on one side only has no height. The points are first averaged over
// squares of a quarter of a pixel side. Pixels are at integer multiples of `pixel_m` from (0, 0).
// Each outermost row and column contains a height. Errors: no pixel has a height; more pixels than
// the limit.
Result<ScanMap> scan_map(const ScanPoints& points, double pixel_m);

}  // namespace mdof::algo
