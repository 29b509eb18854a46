// Peak to valley, root mean square and measured rectangle of a map, and removal of its
// least-squares plane and of pixels that are separate from the part. SI.
#pragma once

#include <cstddef>

#include "schema/form/height_map.h"

namespace mdof::algo {

struct MapFigures {
  double pv_m = 0;   // largest - smallest height
  double rms_m = 0;  // root mean square about mean_m
  double mean_m = 0;
  std::size_t pixels = 0;  // measured pixels
};
MapFigures figures_of(const SurfaceMap& map);

// The first and last column and row with a measured pixel. Requires a measured pixel.
struct MeasuredExtent {
  std::size_t left = 0, right = 0, low = 0, high = 0;
};
MeasuredExtent measured_extent(const SurfaceMap& map);

// Least-squares plane of the measured pixels:
//   z = piston + tilt_x (x - x_mean) + tilt_y (y - y_mean)
// In a map with a single row or column, the tilt that is not determined is 0.
struct Plane {
  double x_mean_m = 0, y_mean_m = 0, piston_m = 0, tilt_x = 0, tilt_y = 0;
  double at(double x_m, double y_m) const {
    return piston_m + tilt_x * (x_m - x_mean_m) + tilt_y * (y_m - y_mean_m);
  }
};
Plane plane_of(const SurfaceMap& map);
void remove_plane(SurfaceMap& map);

// Removes regions of connected pixels (also by a corner) that have less than a hundredth of the
// pixels of the largest region, such as a single wrong pixel beside the part. Adds the number of
// removed pixels to `removed`.
SurfaceMap without_specks(SurfaceMap map, std::size_t& removed);

}  // namespace mdof::algo
