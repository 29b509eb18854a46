// A height map as a smooth surface. It has heights and slopes between the pixels, and also on
// extrapolated pixels beyond the measured pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/form/height_map.h"

namespace mdof::algo {

// How the height of a missing pixel is extrapolated along its row or column. If several sides have
// pixels with a height, the result is the mean of the extrapolations from the sides that have the
// most such pixels (at most 4).
enum class Extension {
  line,     // least-squares line through the nearest four pixels: amplifies noise little
  parabola  // parabola through the nearest three pixels, as smooth as the surface inside the map
};

struct SurfacePoint {
  double z_m = 0, slope_x = 0, slope_y = 0;
};

// Cubic Hermite polynomials between the pixels. The slopes at the pixels are differences over five
// pixels (fourth order). The surface and its slopes are continuous, and the surface is exact at the
// pixels. If pixels are missing, the differences are over three pixels, or the interpolation is
// linear.
class Surface {
 public:
  // Extends the map by `extension` pixels, and by a few more that are used for the slopes only.
  Surface(const SurfaceMap& map, std::size_t extension, Extension how);

  // Calculates height and slopes at a place. Returns false if one of the pixels around the place
  // was extrapolated in a later round than `rings`. With `rings` = 0, these pixels must be
  // measured, and height and slopes depend on measured pixels only: at an edge, slopes are
  // one-sided differences over three measured pixels (exact for a parabola).
  bool at(double x_m, double y_m, std::size_t rings, SurfacePoint& point) const;

 private:
  static constexpr std::uint8_t kNone = 255;
  void extend(std::size_t rings, Extension how);
  std::size_t nx_ = 0, ny_ = 0;
  double x0_m_ = 0, y0_m_ = 0, dx_m_ = 0, dy_m_ = 0;
  std::vector<double> z_m_;
  // Only with Extension::line: the map extended by parabolas, for the slopes at measured pixels. A
  // difference over five pixels then is a one-sided difference over three measured pixels. The line
  // would change heights between measured pixels at the edge of a sphere by 0.15 times its error.
  std::vector<double> near_m_;
  std::vector<std::uint8_t> ring_;  // 0: measured, k: extrapolated in round k, kNone: no height
};

// Largest height by which the surface between two pixels of a row or column leaves the range of
// these two heights, without the part that the curvature at both pixels explains. A step of the
// heights causes 9.3 % of the step, before and after it. Only pixels within `radius_m` count.
double overshoot_m(const SurfaceMap& map, double x_centre_m, double y_centre_m, double radius_m);

// By how much heights between pixels depend on the interpolation: the difference between the cubics
// over six and over four pixels, in the middle between two pixels of a row or column. It is larger
// than the error of the cubic over six pixels. The class contains its mean absolute values over
// rings about a centre, each one pixel wide.
class InterpolationError {
 public:
  InterpolationError(const SurfaceMap& map, double x_centre_m, double y_centre_m, double radius_m);
  // The largest mean of a ring between these radii, or less than 4 pixels outside them. Rows and
  // columns are added.
  double largest_m(double least_radius_m, double most_radius_m) const;

 private:
  double pixel_m_;
  std::vector<double> mean_m_;  // of each ring, from the centre outwards
};

}  // namespace mdof::algo
