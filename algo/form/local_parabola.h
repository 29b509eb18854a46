// Height and curvatures of a least-squares parabola through the heights in a square about a pixel.
// The parabola reduces noise. It is exact for a surface of constant curvature, also at edges and
// holes. README.md describes the effect on waves. SI.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "schema/form/height_map.h"

namespace mdof::algo {

struct Parabola {
  double z_m = 0, xx = 0, yy = 0, xy = 0;  // height and second derivatives (1/m) at the pixel
};

class LocalParabola {
 public:
  // `map` must outlive this object. `least_share`: required share of measured pixels in the square.
  LocalParabola(const SurfaceMap& map, double side_m, double least_share);

  // False: the side is below two pixels, so the square is smaller than 3 x 3.
  bool is_large_enough() const { return ni_ >= 1 && nj_ >= 1; }
  // False: the square has too few measured pixels, or they do not determine a parabola.
  bool at(std::size_t i, std::size_t j, Parabola& found) const;

 private:
  std::size_t size() const { return static_cast<std::size_t>((2 * ni_ + 1) * (2 * nj_ + 1)); }
  Parabola in_m(const std::array<double, 4>& c) const;
  bool fitted(std::ptrdiff_t i, std::ptrdiff_t j, Parabola& found) const;

  const SurfaceMap& map_;
  std::ptrdiff_t ni_, nj_;
  double half_x_m_, half_y_m_, least_share_;
  std::array<std::vector<double>, 4> weight_;  // of the pixels of a complete square, for the
                                               // coefficients of 1, u^2, u v and v^2
};

}  // namespace mdof::algo
