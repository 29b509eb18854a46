// The reference lines of straightness (ISO 230-1) through a series of deviations over positions.
#pragma once

#include <cstddef>
#include <string>

namespace mdof {

// Differences of readings from the line are along the deviation, not perpendicular to the line.
struct ReferenceLine {
  double slope_rad = 0;    // m/m
  double intercept_m = 0;  // value of the line at position 0
  double zone_m = 0;       // peak to valley of the readings about this line
  double residual_m = 0;   // root mean square of the readings about this line
};

struct ReferenceLines {
  std::size_t readings = 0, positions = 0;  // number of readings and of different positions
  double first_m = 0, last_m = 0;
  ReferenceLine end_point, least_squares, minimum_zone;
};

// Lines of one straightness error of a run, for one approach or the mean of both, along the travel
// of the moving body in M.
struct StraightnessLines {
  std::string error_key;  // "EYX_um"
  std::string approach;   // "forward", "reverse", "mean"
  ReferenceLines lines;
};

// Squareness by one line through each of the two straightness errors.
struct SquarenessLine {
  double slope_a_rad = 0, slope_b_rad = 0;
  double error_rad = 0;  // sign as in Squareness
};
struct SquarenessLines {
  SquarenessLine end_point, least_squares, minimum_zone;
};

}  // namespace mdof
