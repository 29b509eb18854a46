// A step of the reading of one probe that neither another probe nor the axis causes.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

struct ProbeStep {
  std::size_t probe = 0, row = 0;
  double size_m = 0;
};

// The largest step of each probe in rows `first` to `last` - 1 that is eight times the changes of
// this probe in the other rows of `begin` ... `end`, if the reading stays there. The caller decides
// whether it is more than noise and rounding, because it knows these.
std::vector<ProbeStep> find_steps(const FrameBlock& frames, std::size_t begin, std::size_t first,
                                  std::size_t last, std::size_t end);

}  // namespace mdof::algo
