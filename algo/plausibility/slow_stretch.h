// An axis that creeps too fast to stand still and too slowly to travel.
#pragma once

#include <cstdint>
#include <optional>

#include "algo/points/dwell_event.h"

namespace mdof::algo {

// Fed with each window of the dwell detection, says when a stretch has ended over which the axis
// hardly moved and yet no stop was found.
class SlowStretch {
 public:
  struct Window {
    std::int64_t begin_ns, end_ns;
    double first_m, last_m;  // where the axis was in its first and its last slot
    double range_m;
    bool still;
  };
  std::optional<DwellEvent> take(const Window& window, double tolerance_m, double least_s,
                                 double most_m);

 private:
  bool under_way_ = false, stood_ = false;
  std::int64_t begin_ns_ = 0;
  double begin_m_ = 0;
};

}  // namespace mdof::algo
