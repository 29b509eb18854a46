// Pose of the target in each set-up, and the effect of the pose on a reading (derivation in
// README.md).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

// Effect of a half turn of the target on the measured surface.
struct HalfTurn {
  double height_sign = 1;  // -1: the surface faces the opposite direction, so the heights have the
                           // opposite sign
  bool end_for_end = false;  // true: the target's direction along the motion is reversed
};

// Effect of a half turn (180°) about the machine axis `about`. `motion`: axis that moves. `normal`:
// axis perpendicular to the surface, not `motion`.
HalfTurn half_turn(Axis motion, Axis normal, Axis about);

// The machine axis perpendicular to the surface, and the index in error_names() of the error along
// this axis. Heights and errors are positive in the + direction of the axis.
struct AcrossSurface {
  Axis normal = Axis::y;
  std::size_t named = 0;
};
AcrossSurface across(Axis motion, Surface surface);

// Change of each reading of a set-up by one standard uncertainty of a declared quantity.
struct DeclaredShift {
  std::string common_as;  // set-ups with the same text have the same quantity; empty: only this
                          // set-up has it
  std::vector<double> shift_m;
};

// Errors of the moving body at positions of the encoder, and the pose of the target.
struct SetUp {
  std::vector<double> position_m, error_m;
  std::vector<double> u_m;  // standard uncertainties of error_m; empty: unknown
  std::vector<DeclaredShift> declared;
  HalfTurn turn;
  // Position in frame C, along the motion, of the zero of the target's length scale. 0 in the first
  // set-up.
  double shift_m = 0;
};

// Place of the probe and sides of the rig, common to all set-ups.
struct ReadAt {
  Sides sides;
  double place_m = 0;  // position of the probe in frame M along the motion
};

// The place on the target that is measured at this position of the encoder, on the target's length
// scale.
double place_on_target(const ReadAt& at, const SetUp& set_up, double position_m);

}  // namespace mdof::algo
