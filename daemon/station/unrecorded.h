// Samples of a run that were not sent to the store yet. They are combined into large blocks,
// because a few large blocks need less work than many small blocks.
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
  // Removes and returns all blocks. Each device has one block. After lost scans or a change of
  // channels, a device has a further block.
  std::vector<SampleBlock> take() { return std::exchange(blocks_, {}); }

 private:
  std::vector<SampleBlock> blocks_;
};

}  // namespace mdof::daemon
