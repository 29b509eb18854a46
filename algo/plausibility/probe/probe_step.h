// Finds steps of the reading of one probe that occur neither in another probe nor in the encoder.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

struct ProbeStep {
  std::size_t probe = 0, row = 0;
  double size_m = 0;
};

// Returns the largest step of each probe in the rows `first` to `last` - 1. A step is larger than
// eight times the changes of this probe in the other rows of `begin` ... `end`, and the reading
// stays at its new value. The caller compares the step with the noise and the rounding of the
// probe.
std::vector<ProbeStep> find_steps(const FrameBlock& frames, std::size_t begin, std::size_t first,
                                  std::size_t last, std::size_t end);

}  // namespace mdof::algo
