// Samples of a run that are not yet sent to the store. They are combined into a few large blocks,
// which need less work than many small ones.
#pragma once

#include <utility>
#include <vector>

#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound.
class Unrecorded {
 public:
  void add(const SampleBlock& block);
  bool empty() const { return blocks_.empty(); }
  // Removes and returns all blocks: one for each device, and another one after lost scans or a
  // change of channels.
  std::vector<SampleBlock> take() { return std::exchange(blocks_, {}); }

 private:
  std::vector<SampleBlock> blocks_;
};

}  // namespace mdof::daemon
