// Events of a log that are not visible in the points.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

enum class DwellEventKind {
  creep,       // the axis crept by size_m within length_s: the stop became no point
  crept,       // the axis crept by a small size_m: the point has the flag "creep"
  short_stop,  // a stop of length_s, too short to be averaged
  hole,        // no frames for length_s; the axis moved by size_m in this time
  jump,        // the encoder's count jumped by size_m
};

struct DwellEvent {
  DwellEventKind kind;
  std::int64_t time_ns = 0;  // start of the event
  double position_m = 0;     // position at the start of the event
  double size_m = 0, length_s = 0;
};

// Returns a notice for each event with its position, its time after `start_ns` and its values. If
// there are many similar events, it returns notices for the first events and one with their number.
// Two kinds of short and creeping stops are not reported: stops outside the outermost points are
// reversals of the axis; stops next to a point are parts of the stop of this point.
Notices event_notices(const std::vector<DwellEvent>& events, const std::vector<Point>& points,
                      std::int64_t start_ns, double needed_s);

}  // namespace mdof::algo
