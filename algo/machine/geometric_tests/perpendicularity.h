// Tilt of the axis of a rotary table against the normal of the plane of two linear axes. All three
// axes move together along a circle (Hwang, Song and Park, Fig. 8 and 9).
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// The tool stays over one spot of the table, so that the form of the table surface has no effect.
// An indicator on the tool measures the height of this spot, + towards +Z.
struct CircleReadings {
  double radius_m = 0;
  std::vector<double>
      angle_rad;  // angle of the spot about the table's axis, + from +X to +Y of the machine
  std::vector<double> height_m;
  std::vector<double> time_s;  // time of each reading; empty: equal time intervals, in this order
  // Values that were measured separately, for each angle; empty if not measured. tilt_a_rad,
  // tilt_b_rad: rotations of the table about X and Y. axes_m: height error by the two linear axes.
  std::vector<double> tilt_a_rad, tilt_b_rad, axes_m;
};
struct Harmonic {
  int order = 1;
  double cosine_m = 0, sine_m = 0, u_m = 0;  // u_m: larger u of cosine_m and sine_m
};
struct Perpendicularity {
  // Rotations about X and Y of the table's axis against the normal of the plane.
  double EA0C_rad = 0, EB0C_rad = 0;
  double u_rad = 0, U_rad = 0, k = 0, freedom = 0;  // for each of EA0C and EB0C
  double size_rad = 0;                              // root sum of squares of EA0C and EB0C
  double mean_m = 0, residual_sd_m = 0;
  double turns = 0;  // total number of turns of the spot, counted positive in both directions
  // Linear drift of the height from the first to the last reading. It is fitted only if `turns` is
  // greater than 7/6; otherwise it is 0.
  bool drift_fitted = false;
  double drift_m = 0, u_drift_m = 0;
  std::vector<Harmonic> harmonics;  // orders 1 ... highest, after subtraction of tilt_a_rad,
                                    // tilt_b_rad and axes_m
  bool tilt_known = false, axes_known = false;
};
// Least-squares fit of
//   height = mean + r (EA0C sin θ - EB0C cos θ) + r (tilt_a sin θ - tilt_b cos θ) + axes
//            + higher harmonics + drift + noise
// u is calculated from the residuals. The noise is assumed to be independent from reading to
// reading. Errors: too few readings; a gap of more than 60° on the circle; a radius outside 0 to
// 100 m; a height above 1 m; times that do not increase; no times, if an angle step exceeds 90° or
// the direction of rotation changes more than once.
Result<Perpendicularity> perpendicularity(const CircleReadings& readings, int highest);

}  // namespace mdof::algo
