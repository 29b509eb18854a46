// A step of one probe's reading that no other probe and not the axis makes.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

struct ProbeStep {
  std::size_t probe = 0, row = 0;
  double size_m = 0;
};

// The largest step of each probe in rows `first` to `last` - 1, where it is eight times what the
// probe does in the other rows of `begin` ... `end`, and the reading stays there. Whether it is
// more than noise and rounding is for the caller, who knows these.
std::vector<ProbeStep> find_steps(const FrameBlock& frames, std::size_t begin, std::size_t first,
                                  std::size_t last, std::size_t end);

}  // namespace mdof::algo
