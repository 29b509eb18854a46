// Deformation of a surface by clamping, and the stress of a bent plate. The elastic part of the
// deformation springs back after the release. The plastic part remains. Wang et al., A
// high-precision machining method of weak-stiffness mirror based on fast tool servo error
// compensation strategy, Micromachines 12 (2021) 607; README.md has the equations. SI.
#pragma once

#include <optional>
#include <string>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct ClampingParts {
  // The whole deformation and its two parts, without piston and tilt.
  SurfaceMap clamping, elastic, plastic;
  double K = 0;  // plastic = K elastic
  // RMS of plastic - K elastic. Set only by clamping_by_release().
  std::optional<double> K_unexplained_rms_m;
};

// `before`: map before clamping. `after`: map of the clamped part. `released`: map after the
// release.
//   clamping = after - before
//   elastic = after - released
//   plastic = released - before
// clamping_by_release() calculates K by least squares. clamping_by_K() calculates both parts from
// `clamping` and K. Errors: K at or below -1; fewer than 4 common pixels.
Result<ClampingParts> clamping_by_release(const SurfaceMap& before, const SurfaceMap& after,
                                          const SurfaceMap& released);
Result<ClampingParts> clamping_by_K(const SurfaceMap& before, const SurfaceMap& after, double K);
// Returns whether the measured K is negative and explains more than half of the RMS of the
// remaining deformation: after the release, the surface is bent in the opposite direction. Noise
// alone gives K from -0.5 to 0, but explains at most 14 % of this RMS.
bool springs_past(const ClampingParts& parts);

// The map `after`, mirrored, is closer to `before` than `after` itself.
struct MirroredMatch {
  std::string mirrored;                  // "x", "y" or "x, y": the directions that are reversed
  double rms_m = 0, mirrored_rms_m = 0;  // differences from `before`, without piston and tilt
};
// Mirrors `after` about the middle of its pixels. nullopt: no mirrored map has less than half of
// the difference.
std::optional<MirroredMatch> mirrored_match(const SurfaceMap& before, const SurfaceMap& after);

struct Plate {
  double thickness_m = 0, youngs_modulus_Pa = 0, poisson = 0;
};

struct PlateStress {
  double max_Pa = 0;        // largest von Mises stress at the face
  double x_m = 0, y_m = 0;  // pixel with max_Pa
  std::size_t pixels = 0;   // pixels whose curvature is known
};

// The stress of a thin plate whose face is bent by `form`. The curvature at a pixel is the
// curvature of a parabola that is fitted over a square of side `smooth_m` about the pixel. Omits a
// pixel if less than half of its square is measured. Errors: no pixel remains (bad_input); the
// square is smaller than 3 x 3 pixels (usage).
Result<PlateStress> plate_stress(const SurfaceMap& form, const Plate& plate, double smooth_m);

}  // namespace mdof::algo
