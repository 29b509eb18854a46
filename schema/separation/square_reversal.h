// Squareness of two axes and angle error of a square. They are separated by means of two set-ups.
#pragma once

namespace mdof {

struct SquareReversal {
  double EC0Y_rad = 0;    // the angle from +X to +Y is 90° + EC0Y
  double square_rad = 0;  // the angle between the two faces, inside the material, is 90° + this
  // For both values: combined standard uncertainty, its part from noise and repeatability, and its
  // part from the declared uncertainties.
  double u_rad = 0, u_random_rad = 0, u_declared_rad = 0;
  double freedom = 0, coverage_factor = 0, U_rad = 0;
  // Results for EC0Y from the first and the second set-up, if the square were perfect.
  double first_rad = 0, second_rad = 0;
  bool noise_only = false;  // true: u contains only noise and repeatability
};

}  // namespace mdof
