// Parallelism of two motions along one axis (ISO 230-1). It is the angle between the straightness
// reference lines of both motions, in each of the two planes that contain the axis.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/iso230/reference_lines.h"
#include "schema/uncertainty/budget.h"

namespace mdof {

struct ParallelismLine {
  // Slopes of the reference lines of motions A and B, over the travel of the moving body in the +
  // direction of M.
  double slope_a_rad = 0, slope_b_rad = 0;
  // slope_b - slope_a. Positive: when the axis moves towards +, motion B deviates from motion A in
  // the + direction of the straightness error (EYX: +Y).
  double angle_rad = 0;
};

struct ParallelismOfPlane {
  std::string error;  // "EYX"
  ParallelismLine end_point, least_squares, minimum_zone;
  Budget budget;  // budget of the least-squares angle
};

// The reference point of the errors of both runs is the origin of the fixture.
struct Parallelism {
  std::int64_t run_a = 0, run_b = 0;
  Axis axis = Axis::x;
  double from_m = 0, to_m = 0;             // common travel
  std::vector<ParallelismOfPlane> planes;  // in the order of error_names()
  bool simulated = false;
};

}  // namespace mdof
