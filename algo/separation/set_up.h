// Pose of the target in each measurement, and its effect on a reading (README.md derives it).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

// Effect of a half turn of the target on the measured surface.
struct HalfTurn {
  double height_sign = 1;  // -1: the surface faces the opposite direction, so hills read as valleys
  bool end_for_end = false;  // the order along the motion is reversed
};

// Half turn (180°) about a machine axis. `motion`: the axis that moves; `normal`: across the
// surface, another axis.
HalfTurn half_turn(Axis motion, Axis normal, Axis about);

// The machine axis across this surface, whose + direction is that of heights and errors, and the
// index of the error along it in error_names().
struct AcrossSurface {
  Axis normal = Axis::y;
  std::size_t named = 0;
};
AcrossSurface across(Axis motion, Surface surface);

// Change of each reading of a set-up by one standard uncertainty of a declared quantity.
struct DeclaredShift {
  std::string common_as;  // set-ups with the same text share the quantity; empty: not shared
  std::vector<double> shift_m;
};

// One measurement: errors of the moving body at positions of the encoder, and the target's pose.
struct SetUp {
  std::vector<double> position_m, error_m;
  std::vector<double> u_m;  // standard uncertainties; empty: not known
  std::vector<DeclaredShift> declared;
  HalfTurn turn;
  // Zero of the target's own length, in C along the motion; in the first set-up it is the zero of
  // C.
  double shift_m = 0;
};

// Place of the readings, common to all set-ups.
struct ReadAt {
  Sides sides;
  double place_m = 0;  // place of the probe in M along the motion
};

// The measured place on the target at this position of the encoder, in the target's own length.
double place_on_target(const ReadAt& at, const SetUp& set_up, double position_m);

}  // namespace mdof::algo
