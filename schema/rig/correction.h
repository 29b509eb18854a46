// The sign of a correction from the machine's chain (algo/README.md, "Frames and signs").
//
// E is an error of the body that the measured axis moves. c is the correction, which is added to
// the command of the axis k: the second letter of the error's name (corrected_by()).
//
//   the measured axis moves   error of the tool against the work   the sum is zero
//   the work                  -E                                   -E + s_k c = 0, c = +E / s_k
//   the tool                  +E                                   +E + s_k c = 0, c = -E / s_k
//
// s_k is the movement (X Y Z) or rotation (A B C) of the tool against the work per unit of c:
// -travel if the axis k moves the work, +travel if it moves the tool. As s_k is +1 or -1,
// 1 / s_k = s_k.
#pragma once

#include <array>
#include <string>

#include "schema/axis.h"
#include "schema/rig/chain.h"
#include "schema/rig/reference.h"
#include "schema/rig/sides.h"

namespace mdof {

// True if the fixture is on the side of the tool, because this axis moves one of the two: the point
// of the tool is then fixed in the frame of the fixture. False: it is on the side of the work.
bool fixture_is_with_tool(const ChainAxis& measured, Sides sides);

// s_k of an axis.
int sign_of_command(const ChainAxis& axis);

struct CorrectionSigns {
  std::array<int, 5> factor{};     // by named error of the axis: c = factor * E; 0: no correction
  std::array<std::string, 5> gap;  // why there is no correction
};
// Requirements for a correction: no rotary axis between the measured and the correcting axis
// changes the direction of the correction. For straightness also: its reference point moves with
// the tool. This is a point of the fixture or, if the fixture is on the side of the work, the
// carriage.
CorrectionSigns correction_signs(const Chain& chain, Axis axis, Sides sides, Reference reference);

// The axis whose command is corrected for a named error: 'Y' for EYX, 'A' for EAX.
char corrected_by(const ErrorName& name);

}  // namespace mdof
