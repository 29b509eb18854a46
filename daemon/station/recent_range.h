// Lowest and highest reading of each probe over the last second, for a view that shows few
// instants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. By the time of the instants, so that the same samples give the same ranges.
class RecentRange {
 public:
  struct Range {
    double low_m = kNaN, high_m = kNaN;  // NaN: no reading
  };
  // A reading that is NaN does not count. Time that goes back begins anew: another pass of a file.
  void add(const FrameBlock& frames);
  // Of the last 0.9 to 1 s up to the newest instant.
  Range of(std::size_t probe) const;

 private:
  static constexpr std::int64_t kPart_ns = 100'000'000;
  static constexpr std::size_t kParts = 10;
  struct Part {
    std::int64_t number = 0;         // time over kPart_ns, rounded down
    std::vector<Range> probes = {};  // empty: nothing was added
  };
  std::array<Part, kParts> parts_;
  std::int64_t newest_ = 0;  // number; 0 before the first
};

}  // namespace mdof::daemon
