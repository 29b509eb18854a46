// Parallelism of two motions along one axis (ISO 230-1): the angle between the reference lines of
// their straightness, in each of the two planes that contain the axis.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/iso230/reference_lines.h"
#include "schema/uncertainty/budget.h"

namespace mdof {

struct ParallelismLine {
  double slope_a_rad = 0, slope_b_rad = 0;  // along the travel of the moving body in + of M
  // slope_b - slope_a. +: as the axis moves to +, B deviates from A towards + of the error's first
  // letter (EYX: to +Y).
  double angle_rad = 0;
};

struct ParallelismOfPlane {
  std::string error;  // "EYX"
  ParallelismLine end_point, least_squares, minimum_zone;
  Budget budget;  // budget of the least-squares angle
};

// Both runs are stated at the fixture.
struct Parallelism {
  std::int64_t run_a = 0, run_b = 0;
  Axis axis = Axis::x;
  double from_m = 0, to_m = 0;             // common travel
  std::vector<ParallelismOfPlane> planes;  // in the order of error_names()
  bool simulated = false;
};

}  // namespace mdof
