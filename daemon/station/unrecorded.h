// A run's samples on their way to the store: a few large blocks, which cost it less than many small
// ones.
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
  // All, and leaves none: one block a device, and another from where its scans were lost or its
  // channels changed.
  std::vector<SampleBlock> take() { return std::exchange(blocks_, {}); }

 private:
  std::vector<SampleBlock> blocks_;
};

}  // namespace mdof::daemon
