// The tilt of a rotary table's axis against the plane in which two linear axes move, from a circle
// that all three move together (Hwang, Song and Park, Fig. 8 and 9).
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// The tool stays over one spot of the table, so that the form of its surface does not count. An
// indicator on the tool reads the height of the spot, + towards +Z.
struct CircleReadings {
  double radius_m = 0;
  std::vector<double>
      angle_rad;  // of the spot about the table's axis, from +X to +Y, in the machine
  std::vector<double> height_m;
  std::vector<double> time_s;  // of each reading; empty: equal times from reading to reading
  // Known from elsewhere, or empty: turns of the table about X and Y at this angle (its tilt
  // motion), and the height by the two linear axes' own errors.
  std::vector<double> tilt_a_rad, tilt_b_rad, axes_m;
};
struct Harmonic {
  int order = 1;
  double cosine_m = 0, sine_m = 0, u_m = 0;  // u of each of the two
};
struct Perpendicularity {
  double EA0C_rad = 0,
         EB0C_rad = 0;  // the axis is tilted against the normal of the plane by these turns
  double u_rad = 0, U_rad = 0, k = 0, freedom = 0;  // of each of the two
  double size_rad = 0;                              // of both together
  double mean_m = 0, residual_sd_m = 0;
  double turns = 0;  // that the spot went in all, in either sense
  // The linear drift of the height between the turns, from the first reading to the last. Not
  // fitted (0) where the spot was not seen again on more than a sixth of a turn.
  bool drift_fitted = false;
  double drift_m = 0, u_drift_m = 0;
  std::vector<Harmonic> harmonics;  // 1 ... the highest, tilt and axes taken away
  bool tilt_known = false, axes_known = false;
};
// height = mean + r (EA0C sin θ - EB0C cos θ) + r (tilt_a sin θ - tilt_b cos θ) + axes + higher
// harmonics + drift + noise, by least squares. u from the residuals, whose noise is taken to be
// independent from reading to reading. Errors: too few readings, a part of a turn, no radius, times
// that do not increase.
Result<Perpendicularity> perpendicularity(const CircleReadings& readings, int highest);

}  // namespace mdof::algo
