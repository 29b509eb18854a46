// Minimum and maximum reading of each probe over the last second, for a view that shows few
// instants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. Uses the time of the instants, so that the same samples give the same ranges.
class RecentRange {
 public:
  struct Range {
    double low_m = kNaN, high_m = kNaN;  // NaN: no reading
  };
  // NaN readings are ignored. If the time decreases (another pass of a file), it starts again.
  void add(const FrameBlock& frames);
  // Range over the last 0.9 to 1 s up to and including the newest instant.
  Range of(std::size_t probe) const;

 private:
  static constexpr std::int64_t kPart_ns = 100'000'000;
  static constexpr std::size_t kParts = 10;
  struct Part {
    std::int64_t number = 0;         // time divided by kPart_ns, rounded down
    std::vector<Range> probes = {};  // empty: no readings
  };
  std::array<Part, kParts> parts_;
  std::int64_t newest_ = 0;  // part number; 0 before the first
};

}  // namespace mdof::daemon
