// All targets visited again at a constant shift, which is how a jump of the encoder's count
// appears.
#pragma once

#include <cstdint>
#include <optional>

#include "algo/sequence/sequence.h"

namespace mdof::algo {

struct ShiftedTargets {
  std::int64_t time_ns = 0;  // time of the last visit at the old positions
  double shift_m = 0;        // from the old to the new positions, along the encoder
};

// Finds a time before and after which different targets are visited, at least three each, and those
// after it are those before it shifted by one distance, less than half of their range, within 50
// µm. This is the only sign of a jump while the axis reverses or creeps, because a step of one
// sample then looks like motion.
std::optional<ShiftedTargets> find_shifted_targets(const Sequence& sequence);

}  // namespace mdof::algo
