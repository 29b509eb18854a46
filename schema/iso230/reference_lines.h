// The straightness reference lines of ISO 230-1 for a series of deviations at positions.
#pragma once

#include <cstddef>
#include <string>

namespace mdof {

// Distances of the readings from the line are measured in the direction of the deviation, not
// perpendicular to the line.
struct ReferenceLine {
  double slope_rad = 0;    // m/m
  double intercept_m = 0;  // value of the line at position 0
  double zone_m = 0;       // peak-to-valley distance of the readings from this line
  double residual_m = 0;   // root mean square distance of the readings from this line
};

struct ReferenceLines {
  std::size_t readings = 0, positions = 0;  // number of readings and of different positions
  double first_m = 0, last_m = 0;
  ReferenceLine end_point, least_squares, minimum_zone;
};

// Reference lines of one straightness error of a run, for one approach or for the mean of both
// approaches, over the travel of the moving body in M.
struct StraightnessLines {
  std::string error_key;  // "EYX_um"
  std::string approach;   // "forward", "reverse", "mean"
  ReferenceLines lines;
};

// Squareness calculated with one kind of reference line for both straightness errors.
struct SquarenessLine {
  double slope_a_rad = 0, slope_b_rad = 0;
  double error_rad = 0;  // sign as in Squareness
};
struct SquarenessByLine {
  SquarenessLine end_point, least_squares, minimum_zone;
};

}  // namespace mdof
