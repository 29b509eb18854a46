// Two maps of the same part, laid onto each other: B - A at the pixels of A. SI.
#pragma once

#include <cstddef>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

enum class Register {
  rigid,  // shift, turn, piston and tilt of B against A are taken out
  plane,  // piston and tilt
  none
};

// How B lies against A: what is at p in A is at R(turn) p + shift in B.
struct MapPose {
  double shift_x_m = 0, shift_y_m = 0, turn_rad = 0;
};

struct Comparison {
  SurfaceMap difference;  // B - A, over the pixels of A
  MapPose pose;
  // Directions among shift x, shift y and turn that the shape does not determine (a sphere can
  // turn, and be tilted instead of shifted), and those in which the slopes of the two maps have
  // nothing in common: they were taken as 0.
  std::size_t undetermined = 0;
  // Mean size of what is left at common places, as a share of what is left with B as it lies
  // (piston and tilt taken out of both); 1 without a movement.
  double left_by_movement = 1;
  double moved_m = 0;          // upper bound of how far that movement takes a place of A
  double pv_m = 0, rms_m = 0;  // rms about the mean
  std::size_t pixels = 0;
};

// Error bad_input: less than a tenth of A's pixels has a counterpart in B.
Result<Comparison> compare(const SurfaceMap& a, const SurfaceMap& b, Register how);

// B - A where both have pixels, B between its pixels where they do not coincide; nothing taken out.
// The same error.
Result<SurfaceMap> difference(const SurfaceMap& a, const SurfaceMap& b);

}  // namespace mdof::algo
