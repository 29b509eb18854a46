// Keeps blocks after they were processed. The acquisition thread uses the memory of these blocks
// again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "schema/sample.h"

namespace mdof::daemon {

// Thread-safe.
class SpareBlocks {
 public:
  void put(SampleBlock block) {
    const std::lock_guard lock(mutex_);
    if (blocks_.size() < kMost) blocks_.push_back(std::move(block));
  }
  // Removes and returns the newest block of this device, because its memory has the right size. If
  // no block of this device exists, returns an empty block.
  SampleBlock take(const std::string& device) {
    const std::lock_guard lock(mutex_);
    const auto last = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                   [&](const SampleBlock& b) { return b.device == device; });
    if (last == blocks_.rend()) return {};
    SampleBlock block = std::move(*last);
    blocks_.erase(std::next(last).base());
    return block;
  }

 private:
  static constexpr std::size_t kMost = 16;
  std::mutex mutex_;
  std::vector<SampleBlock> blocks_;
};

}  // namespace mdof::daemon
