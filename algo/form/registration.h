// Registration of two maps of the same part: B - A at the pixels of A. SI.
#pragma once

#include <cstddef>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

enum class Register {
  rigid,  // removes shift, turn, piston and tilt of B relative to A
  plane,  // removes piston and tilt
  none
};

// Pose of B relative to A: the place p in A corresponds to the place R(turn) p + shift in B.
struct MapPose {
  double shift_x_m = 0, shift_y_m = 0, turn_rad = 0;
};

// A movement that a search finds must have a counterpart in B for this share of the pixels of A.
inline constexpr double kRegistrationOverlap = 0.6;

struct Comparison {
  SurfaceMap difference;  // B - A, over the pixels of A
  MapPose pose;
  // Number of directions, among shift x, shift y and turn and their combinations, in which the
  // movement of B is set to 0, because the maps do not determine it. Example: the turn of a sphere
  // about its axis. Another example: a direction in which the slopes of the two maps are not
  // correlated.
  std::size_t undetermined = 0;
  // Mean absolute residual with the movement of B, divided by the mean absolute residual without
  // this movement. Piston and tilt are removed in both cases. 1 if B is not moved. 0 if the maps
  // have too few common pixels without the movement (kRegistrationOverlap).
  double residual_ratio = 1;
  double moved_m = 0;          // upper bound of the displacement of any place of A by the movement
  double pv_m = 0, rms_m = 0;  // of `difference`; rms_m about the mean
  std::size_t pixels = 0;
};

// Error bad_input: less than a tenth of the pixels of A have a counterpart in B.
Result<Comparison> compare(const SurfaceMap& a, const SurfaceMap& b, Register how);

// B - A at the pixels of A, with B interpolated between its pixels. Piston and tilt are not
// removed. Error: as compare().
Result<SurfaceMap> difference(const SurfaceMap& a, const SurfaceMap& b);

}  // namespace mdof::algo
