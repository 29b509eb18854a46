// A selection of the measured pixels of a map, spread evenly. SI.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/form/registration.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct Places {
  // Middle of the smallest rectangle that contains all measured pixels, and the larger side of this
  // rectangle.
  double x_mid_m = 0, y_mid_m = 0, size_m = 0;
  std::vector<double> x_m, y_m, z_m;
};

Places places_of(const SurfaceMap& a, std::size_t most);

// The rotation of a pose about the middle of A. The place p in A is at R p + shift in B; both
// places are relative to the middle of A.
struct Turn {
  double cos = 1, sin = 0;
  explicit Turn(double rad);
  double x_m(double x, double y) const { return cos * x - sin * y; }
  double y_m(double x, double y) const { return sin * x + cos * y; }
};

// The same pose about (0, 0), with its turn in (-pi, pi].
MapPose about_origin(const MapPose& about_middle, const Places& a);

}  // namespace mdof::algo
