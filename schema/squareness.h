// Squareness of two axes from one run along each against the same target square (Fig. 6).
#pragma once

#include <cstdint>
#include <string>

namespace mdof {

// What is known of the square: at the corner of the face that the X run looks at and the one that
// the Y run looks at, the material encloses 90° + angle_error_rad.
struct SquareArtefact {
  double angle_error_rad = 0;
  double u_rad = 0;  // standard uncertainty
  // +1: the corner is the one at +X +Y or at -X -Y, -1: at -X +Y or at +X -Y; 0: not known
  int corner = 0;
  bool operator==(const SquareArtefact&) const = default;
};

// EC0Y: the angle from +X to +Y is 90° + EC0Y. All of it stated at the fixture.
//   EC0Y = -slope(EXY over y) - slope(EYX over x) + corner * artefact angle error
struct Squareness {
  std::int64_t id = 0;  // 0 until stored
  std::int64_t run_x = 0, run_y = 0;
  double EC0Y_rad = 0;
  // Combined standard uncertainties, as their budgets have them; what algo::squareness() makes is
  // of noise, repeatability and the artefact alone.
  double u_EC0Y_rad = 0;
  // How far the axes are from straight lines: √(s_X² + s_Y²), s the standard deviation of a fitted
  // slope that follows from the residuals of its line. It says how well one angle describes such
  // axes, not how well it is known.
  double form_rad = 0;
  // Over the travel of the moving body along + of M.
  double slope_EYX_rad = 0, u_slope_EYX_rad = 0;
  double slope_EXY_rad = 0, u_slope_EXY_rad = 0;
  SquareArtefact artefact;
  bool simulated = false;
  std::string created_utc;
  bool operator==(const Squareness&) const = default;
};

}  // namespace mdof
