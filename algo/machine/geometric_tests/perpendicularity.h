// Tilt of a rotary table's axis relative to the plane in which two linear axes move, from a circle
// that all three axes move together (Hwang, Song and Park, Fig. 8 and 9).
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// The tool stays over one spot of the table, so the form of its surface has no effect. An indicator
// on the tool measures the height of the spot, + towards +Z.
struct CircleReadings {
  double radius_m = 0;
  std::vector<double>
      angle_rad;  // angle of the spot about the table's axis, from +X to +Y, in the machine
  std::vector<double> height_m;
  std::vector<double> time_s;  // time of each reading; empty: equal time intervals
  // Measured separately, or empty: rotations of the table about X and Y at this angle (its tilt
  // motion), and the height by the errors of the two linear axes.
  std::vector<double> tilt_a_rad, tilt_b_rad, axes_m;
};
struct Harmonic {
  int order = 1;
  double cosine_m = 0, sine_m = 0, u_m = 0;  // u of each of cosine_m and sine_m
};
struct Perpendicularity {
  double EA0C_rad = 0,
         EB0C_rad = 0;  // the axis is tilted against the normal of the plane by these turns
  double u_rad = 0, U_rad = 0, k = 0, freedom = 0;  // for each of EA0C and EB0C
  double size_rad = 0;                              // size of both together
  double mean_m = 0, residual_sd_m = 0;
  double turns = 0;  // total turns of the spot, in either direction
  // Linear drift of the height between the turns, from the first reading to the last. It is not
  // fitted (0) unless `turns` is more than a turn and a sixth.
  bool drift_fitted = false;
  double drift_m = 0, u_drift_m = 0;
  std::vector<Harmonic> harmonics;  // orders 1 ... highest, without tilt and axes
  bool tilt_known = false, axes_known = false;
};
// height = mean + r (EA0C sin θ - EB0C cos θ) + r (tilt_a sin θ - tilt_b cos θ) + axes + higher
// harmonics + drift + noise, by least squares. u comes from the residuals; their noise is assumed
// to be independent from reading to reading. Errors: too few readings, less than a whole turn, no
// radius, times that do not increase.
Result<Perpendicularity> perpendicularity(const CircleReadings& readings, int highest);

}  // namespace mdof::algo
