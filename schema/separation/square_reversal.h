// The squareness of two axes and the angle error of a square, separated by two set-ups.
#pragma once

namespace mdof {

struct SquareReversal {
  double EC0Y_rad = 0;    // the angle from +X to +Y is 90° + EC0Y
  double square_rad = 0;  // the material encloses 90° + this at the corner of its two faces
  // Of either: combined, what of it is noise and repeatability, what the rigs declare.
  double u_rad = 0, u_random_rad = 0, u_declared_rad = 0;
  double freedom = 0, coverage_factor = 0, U_rad = 0;
  double first_rad = 0, second_rad = 0;  // EC0Y of each set-up, the square taken to be true
  bool noise_only = false;               // the rigs declare nothing
};

}  // namespace mdof
