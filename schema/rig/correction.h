// The sign of a correction from the machine's chain (DESIGN §3, "Sides and signs").
//
// E is the error of the body that moves. The error of the tool against the work is -E for an axis
// that carries the work and +E for one that carries the tool. A command c of axis k moves (X Y Z)
// or turns (A B C) the tool against the work by s_k c, s_k = -travel for an axis that carries the
// work, +travel for one that carries the tool. The correction makes the sum zero: c = ∓E / s_k.
#pragma once

#include <array>
#include <string>

#include "schema/axis.h"
#include "schema/rig/chain.h"

namespace mdof {

struct CorrectionSigns {
  std::array<int, 5> factor{};     // by named error of the axis: c = factor * E; 0: none
  std::array<std::string, 5> gap;  // why there is none
};
CorrectionSigns correction_signs(const Chain& chain, Axis axis);

// The axis whose command takes the correction of a named error: 'Y' for EYX, 'A' for EAX.
char corrected_by(const ErrorName& name);

}  // namespace mdof
