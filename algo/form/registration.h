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

// Pose of B relative to A: the place p in A is the place R(turn) p + shift in B.
struct MapPose {
  double shift_x_m = 0, shift_y_m = 0, turn_rad = 0;
};

struct Comparison {
  SurfaceMap difference;  // B - A, over the pixels of A
  MapPose pose;
  // Number of directions among shift x, shift y and turn that were taken as 0: the shape does not
  // determine them (a sphere can turn, and be tilted instead of shifted), or the slopes of the two
  // maps have nothing in common in them.
  std::size_t undetermined = 0;
  // Mean size of the residual at common places, divided by the residual without a movement of B
  // (piston and tilt removed in both); 1 without a movement.
  double residual_ratio = 1;
  double moved_m = 0;          // upper bound of the displacement of a place of A by that movement
  double pv_m = 0, rms_m = 0;  // rms about the mean
  std::size_t pixels = 0;
};

// Error bad_input: less than a tenth of A's pixels has a counterpart in B.
Result<Comparison> compare(const SurfaceMap& a, const SurfaceMap& b, Register how);

// B - A where both have pixels, with B interpolated between its pixels; nothing is removed. Error:
// as compare().
Result<SurfaceMap> difference(const SurfaceMap& a, const SurfaceMap& b);

}  // namespace mdof::algo
