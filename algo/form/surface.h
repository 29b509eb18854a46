// A height map as a smooth surface: heights and slopes between the pixels, and on extrapolated
// pixels beyond the measured ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/form/height_map.h"

namespace mdof::algo {

// How a missing pixel gets its height from measured pixels beside it in its row or column. If
// several sides have measured pixels, the mean is used.
enum class Extension {
  line,     // line through the last four pixels (least squares): little noise
  parabola  // through the last three: interpolates at the edge as it does inside
};

struct SurfacePoint {
  double z_m = 0, slope_x = 0, slope_y = 0;
};

// Cubic Hermite polynomials between the pixels. The slopes at the pixels are differences over five
// pixels (fourth order). The surface and its slopes are continuous, and it is exact at the pixels.
// If pixels are missing, the differences are over three pixels, or the interpolation is linear.
class Surface {
 public:
  // Extends the map by `extension` pixels, and by a few more that are used for the slopes only.
  Surface(const SurfaceMap& map, std::size_t extension, Extension how);

  // False: a pixel that contributes at this place is more than `rings` pixels away from a measured
  // one (0: all contributing pixels must be measured).
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
