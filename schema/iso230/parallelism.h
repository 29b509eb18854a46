// Parallelism of two motions along one axis (ISO 230-1): the angle between the reference lines of
// their straightness, in each of the two planes that hold the axis.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/iso230/reference_lines.h"
#include "schema/uncertainty/budget.h"

namespace mdof {

struct ParallelismLine {
  double slope_a_rad = 0, slope_b_rad = 0;  // over the moving body's own travel along + of M
  // slope_b - slope_a; +: as the axis goes to +, B leads away from A to + of the error's first
  // letter (EYX: to +Y).
  double angle_rad = 0;
};

struct ParallelismOfPlane {
  std::string error;  // "EYX"
  ParallelismLine end_point, least_squares, minimum_zone;
  Budget budget;  // of the angle by least squares
};

// Both stated at the fixture.
struct Parallelism {
  std::int64_t run_a = 0, run_b = 0;
  Axis axis = Axis::x;
  double from_m = 0, to_m = 0;             // the travel that both have
  std::vector<ParallelismOfPlane> planes;  // as error_names() has them
  bool simulated = false;
};

}  // namespace mdof
