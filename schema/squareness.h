// Squareness of two axes from one run along each against the same target square (DESIGN §3).
#pragma once

#include <cstdint>
#include <string>

namespace mdof {

// EC0Y: the angle from +X to +Y is 90° + EC0Y.
//   EC0Y = -slope(EXY over y) - slope(EYX over x) - artefact angle error
struct Squareness {
  std::int64_t id = 0;  // 0 until stored
  std::int64_t run_x = 0, run_y = 0;
  double EC0Y_rad = 0;
  double u_EC0Y_rad = 0;  // standard uncertainty: both slopes and the artefact
  double slope_EYX_rad = 0, u_slope_EYX_rad = 0;
  double slope_EXY_rad = 0, u_slope_EXY_rad = 0;
  double artefact_angle_error_rad = 0;
  bool simulated = false;
  std::string created_utc;
};

}  // namespace mdof
