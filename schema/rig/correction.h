// The sign of a correction from the machine's chain (algo/README.md, "Frames and signs").
//
// E is an error of the body that the measured axis moves, c the correction: what is added to the
// command of the axis k that the error's name has in second place (corrected_by()).
//
//   the measured axis carries   error of the tool against the work   the sum is zero
//   the work                    -E                                   -E + s_k c = 0, c = +E / s_k
//   the tool                    +E                                   +E + s_k c = 0, c = -E / s_k
//
// s_k is how far c moves (X Y Z) or turns (A B C) the tool against the work: -travel where the axis
// k carries the work, +travel where it carries the tool. As s_k is +1 or -1, 1 / s_k is s_k.
#pragma once

#include <array>
#include <string>

#include "schema/axis.h"
#include "schema/rig/chain.h"
#include "schema/rig/reference.h"
#include "schema/rig/sides.h"

namespace mdof {

// The fixture is on the side of the tool, as this axis moves one of the two: the tool's point is
// one of the fixture's frame. Else it is on the side of the work.
bool fixture_is_with_tool(const ChainAxis& measured, Sides sides);

// s_k of an axis.
int sign_of_command(const ChainAxis& axis);

struct CorrectionSigns {
  std::array<int, 5> factor{};     // by named error of the axis: c = factor * E; 0: none
  std::array<std::string, 5> gap;  // why there is none
};
// An error has one only where no rotary axis between the measured axis and the correcting one turns
// the direction of the correction. Straightness has one only where the point that it is stated at
// goes with the tool: a point of the fixture, or, where the fixture is on the side of the work, the
// carriage.
CorrectionSigns correction_signs(const Chain& chain, Axis axis, Sides sides, Reference reference);

// The axis whose command takes the correction of a named error: 'Y' for EYX, 'A' for EAX.
char corrected_by(const ErrorName& name);

}  // namespace mdof
