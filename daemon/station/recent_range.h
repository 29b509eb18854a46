// Smallest and largest reading of each probe during the last second. The live view shows these
// readings, because only few of the frames are shown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. Uses the times of the frames and no clock. The result therefore depends only on the
// samples.
class RecentRange {
 public:
  struct Range {
    double low_m = kNaN, high_m = kNaN;  // NaN: no reading
  };
  // Ignores NaN. If the time decreases (a file is read again), all older readings are removed.
  void add(const FrameBlock& frames);
  // The range during the last 0.9 s to 1 s, including the newest frame.
  Range of(std::size_t probe) const;

 private:
  static constexpr std::int64_t kPart_ns = 100'000'000;
  static constexpr std::size_t kParts = 10;
  struct Part {
    std::int64_t number = 0;         // time of the frames divided by kPart_ns, rounded down
    std::vector<Range> probes = {};  // range of each probe; empty: no readings
  };
  std::array<Part, kParts> parts_;
  std::int64_t newest_ = 0;  // number of the newest part; 0 before the first frame
};

}  // namespace mdof::daemon
