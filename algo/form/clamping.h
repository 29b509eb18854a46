// Effects of clamping on a surface: the elastic part, which springs back, the plastic part, which
// remains, and the stress. Wang et al., A high-precision machining method of weak-stiffness mirror
// based on fast tool servo error compensation strategy, Micromachines 12 (2021) 607; README.md has
// the equations. SI.
#pragma once

#include <optional>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct ClampingParts {
  SurfaceMap clamping, elastic, plastic;  // without piston and tilt
  double K = 0;                           // plastic = K elastic
  // RMS of plastic - K elastic, measured; only with `released`.
  std::optional<double> K_unexplained_rms_m;
};

// Maps before clamping, after clamping, and after the release: elastic = after - released, plastic
// = released - before, K by least squares. Without `released` both parts follow from K. Errors: K
// at or below -1, maps that do not overlap.
Result<ClampingParts> clamping_by_release(const SurfaceMap& before, const SurfaceMap& after,
                                          const SurfaceMap& released);
Result<ClampingParts> clamping_by_K(const SurfaceMap& before, const SurfaceMap& after, double K);

struct Plate {
  double thickness_m = 0, youngs_modulus_Pa = 0, poisson = 0;
};

struct PlateStress {
  double max_Pa = 0;  // von Mises, at the face
  double x_m = 0, y_m = 0;
  std::size_t pixels = 0;  // pixels with a known curvature
};

// The stress of a thin plate whose face is bent by `form`. The curvature is that of a parabola
// fitted over a square of side `smooth_m` about each pixel; pixels with less than half of the
// square measured are omitted. Error bad_input: no pixel remains, or the square is smaller than 3
// pixels.
Result<PlateStress> plate_stress(const SurfaceMap& form, const Plate& plate, double smooth_m);

}  // namespace mdof::algo
