// Finds a constant shift of all targets during a run. A jump of the encoder's count causes such a
// shift.
#pragma once

#include <cstdint>
#include <optional>

#include "algo/sequence/sequence.h"

namespace mdof::algo {

struct ShiftedTargets {
  std::int64_t time_ns = 0;  // time of the last visit at the old positions
  double shift_m = 0;        // from the old to the new positions, along the encoder
};

// Finds a time with these properties:
// - At least three targets are visited only before this time, and at least three other targets only
//   after this time.
// - The later positions are the earlier positions plus one shift, within 50 µm.
// - The shift is less than half of the range of the targets.
//
// If the count jumps while the axis reverses or creeps, find_jump() cannot distinguish the jump
// from motion, so only this function finds it.
std::optional<ShiftedTargets> find_shifted_targets(const Sequence& sequence);

}  // namespace mdof::algo
