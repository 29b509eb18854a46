// Figures of a map: peak to valley and root mean square; removal of a plane. SI.
#pragma once

#include <cstddef>

#include "schema/form/height_map.h"

namespace mdof::algo {

struct MapFigures {
  double pv_m = 0;   // largest - smallest height
  double rms_m = 0;  // about the mean
  double mean_m = 0;
  std::size_t pixels = 0;  // measured pixels
};
MapFigures figures_of(const SurfaceMap& map);

// z = piston + tilt_x (x - x_mean) + tilt_y (y - y_mean) by least squares over the measured pixels.
// A tilt that the pixels do not determine (a single row or column) is 0.
struct Plane {
  double x_mean_m = 0, y_mean_m = 0, piston_m = 0, tilt_x = 0, tilt_y = 0;
  double at(double x_m, double y_m) const {
    return piston_m + tilt_x * (x_m - x_mean_m) + tilt_y * (y_m - y_mean_m);
  }
};
Plane plane_of(const SurfaceMap& map);
void remove_plane(SurfaceMap& map);

}  // namespace mdof::algo
