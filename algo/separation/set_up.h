// How the target lay in each measurement, and what that does to a reading (README.md derives it).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

// What half a turn of the target does to the surface that is looked at.
struct HalfTurn {
  double height_sign = 1;    // -1: it looks the other way, so that its hills read as valleys
  bool end_for_end = false;  // what was first along the motion comes last
};

// Turned by 180° about a machine axis. `motion`: the axis that moves; `normal`: across the surface,
// another one.
HalfTurn half_turn(Axis motion, Axis normal, Axis about);

// The machine axis across this surface, along whose + heights and errors count, and the place of
// the error along it in the order of error_names().
struct AcrossSurface {
  Axis normal = Axis::y;
  std::size_t named = 0;
};
AcrossSurface across(Axis motion, Surface surface);

// By how much one standard uncertainty of a declared quantity changes each reading of a set-up.
struct DeclaredShift {
  std::string common_as;  // set-ups that have the same here share the quantity; empty: their own
  std::vector<double> shift_m;
};

// One measurement: errors of the moving body at positions of the encoder, and how the target lay.
struct SetUp {
  std::vector<double> position_m, error_m;
  std::vector<double> u_m;  // standard uncertainties; empty: not known
  std::vector<DeclaredShift> declared;
  HalfTurn turn;
  // In C along the motion: where the zero of the target's own length lies, which in the
  // first set-up is that of C.
  double shift_m = 0;
};

// Where the reading is taken, common to all set-ups.
struct ReadAt {
  Sides sides;
  double place_m = 0;  // of the probe in M along the motion
};

// The place on the target that is read at this position of the encoder, in its own length.
double place_on_target(const ReadAt& at, const SetUp& set_up, double position_m);

}  // namespace mdof::algo
