// A height map as a smooth surface: heights and slopes between the pixels, and beyond the measured
// ones as far as they were extended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/form/height_map.h"

namespace mdof::algo {

// How a missing pixel gets its height from measured ones beside it in its row or column. Where
// several sides have some, it is their mean.
enum class Extension {
  line,     // the line through the last four pixels (least squares): little noise
  parabola  // through the last three: keeps the interpolation at the edge as it is within
};

struct SurfacePoint {
  double z_m = 0, slope_x = 0, slope_y = 0;
};

// Hermite's cubics between the pixels, with slopes at them by differences over five (of fourth
// order): continuous with its slopes, exact at the pixels. Where it lacks pixels for that, over
// three, or straight.
class Surface {
 public:
  // The outermost `extension` pixels are heights; a few more are there for the slopes alone.
  Surface(const SurfaceMap& map, std::size_t extension, Extension how);

  // False: a pixel with a part in this place is farther than `rings` pixels from a measured one
  // (0: all of them are measured).
  bool at(double x_m, double y_m, std::size_t rings, SurfacePoint& point) const;

 private:
  static constexpr std::uint8_t kNone = 255;
  void extend(std::size_t rings, Extension how);
  std::size_t nx_ = 0, ny_ = 0;
  double x0_m_ = 0, y0_m_ = 0, dx_m_ = 0, dy_m_ = 0;
  std::vector<double> z_m_;
  std::vector<std::uint8_t> ring_;  // 0 measured, k: filled in round k, kNone
};

}  // namespace mdof::algo
