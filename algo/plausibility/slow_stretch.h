// Finds intervals in which the axis moves slowly: too fast for a stop, and too slowly for a motion
// between targets.
#pragma once

#include <cstdint>
#include <optional>

#include "algo/points/dwell_event.h"

namespace mdof::algo {

// Takes each window of the dwell detection. take() returns an event at the end of an interval in
// which the axis moved slowly and no stop was found. The interval is at least `least_s` long, and
// the axis moved by at most `most_m` in it.
class SlowStretch {
 public:
  struct Window {
    std::int64_t begin_ns, end_ns;
    // Positions of the axis in the first and the last slot.
    double first_m, last_m;
    double range_m;
    bool still;
  };
  std::optional<DwellEvent> take(const Window& window, double tolerance_m, double least_s,
                                 double most_m);

 private:
  bool is_slow_ = false, stood_ = false;
  std::int64_t begin_ns_ = 0;
  double begin_m_ = 0;
};

}  // namespace mdof::algo
