// Squareness of two axes and angle error of a square, separated by two set-ups.
#pragma once

namespace mdof {

struct SquareReversal {
  double EC0Y_rad = 0;    // the angle from +X to +Y is 90° + EC0Y
  double square_rad = 0;  // the angle of the material at the corner of the two faces is 90° + this
  // For both values: combined uncertainty, its part from noise and repeatability, its declared
  // part.
  double u_rad = 0, u_random_rad = 0, u_declared_rad = 0;
  double freedom = 0, coverage_factor = 0, U_rad = 0;
  double first_rad = 0, second_rad = 0;  // EC0Y of each set-up if the square were perfect
  bool noise_only = false;               // the rigs declare nothing
};

}  // namespace mdof
