// All targets visited again a little further on, which a jump of the encoder's count looks like.
#pragma once

#include <cstdint>
#include <optional>

#include "algo/sequence/sequence.h"

namespace mdof::algo {

struct ShiftedTargets {
  std::int64_t time_ns = 0;  // of the last visit to where they were before
  double shift_m = 0;        // to where they are after it, along the encoder
};

// A moment before and after which other targets are visited, at least three each, and those after
// it are those before it displaced by one distance, less than half of their range, within 50 µm. A
// jump while the axis turns or creeps is shown by nothing else: a step of one sample looks like
// motion.
std::optional<ShiftedTargets> find_shifted_targets(const Sequence& sequence);

}  // namespace mdof::algo
