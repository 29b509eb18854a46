// Finds the sign of a correction from the kinematic chain of the machine (algo/README.md, "Frames
// and signs").
//
// E is an error of the body that the measured axis moves. c is the correction: it is added to the
// command of the axis k. corrected_by() returns the axis k; it is the second letter of the error's
// name.
//
//   the measured axis moves   error of tool relative to work   the sum must be zero
//   the work                  -E                               -E + s_k c = 0, c = +E / s_k
//   the tool                  +E                               +E + s_k c = 0, c = -E / s_k
//
// s_k is the movement (axes X Y Z) or the rotation (axes A B C) of the tool relative to the work
// per unit of c. s_k = -travel if the axis k moves the work, and s_k = +travel if the axis k moves
// the tool. travel is -1 if the body of the axis moves in the - direction when the command
// increases, otherwise +1. Because s_k is +1 or -1, 1 / s_k = s_k.
#pragma once

#include <array>
#include <string>

#include "schema/axis.h"
#include "schema/rig/chain.h"
#include "schema/rig/reference.h"
#include "schema/rig/sides.h"

namespace mdof {

// True: the fixture is on the side of the tool. The point of the tool is then fixed in the frame of
// the fixture. False: the fixture is on the side of the work. `measured` moves either the fixture
// or the target.
bool fixture_is_with_tool(const ChainAxis& measured, Sides sides);

// Returns s_k of an axis.
int sign_of_command(const ChainAxis& axis);

struct CorrectionSigns {
  std::array<int, 5> factor{};     // for each error of the axis: c = factor * E; 0: no correction
  std::array<std::string, 5> gap;  // reason why there is no correction
};
// A correction is possible if no rotary axis between the measured axis and the correcting axis
// changes the direction of the correction. A correction of straightness also requires a reference
// point that moves with the tool. If the fixture is on the side of the tool, this is a point of the
// fixture; otherwise it is the carriage.
CorrectionSigns correction_signs(const Chain& chain, Axis axis, Sides sides, Reference reference);

// The axis whose command corrects an error: 'Y' for EYX, 'A' for EAX.
char corrected_by(const ErrorName& name);

}  // namespace mdof
