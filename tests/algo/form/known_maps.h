// Maps of known surfaces.
#pragma once

#include <cmath>
#include <cstddef>

#include "schema/form/height_map.h"

namespace mdof::algo {

inline constexpr double kDeg = 0.017453292519943295;

inline double bumps(double x_m, double y_m) {
  return 1e-6 * (std::sin(x_m / 9e-3 + 0.4) * std::cos(y_m / 7e-3) +
                 0.5 * std::sin((x_m + 2 * y_m) / 13e-3) + 0.3 * std::cos(x_m / 21e-3 - 0.7));
}

template <class F>
SurfaceMap map_of(F&& z, double x0_m = -30e-3, double y0_m = -20e-3, double d_m = 0.5e-3,
                  std::size_t nx = 121, std::size_t ny = 81) {
  SurfaceMap map{"map", x0_m, y0_m, d_m, d_m, nx, ny, {}, {}};
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) map.z_m.push_back(z(map.x_m(i), map.y_m(j)));
  return map;
}

}  // namespace mdof::algo
