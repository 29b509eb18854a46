// Events of a log during stops and motions that the points alone do not show.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

enum class DwellEventKind {
  creep,       // a stop that moved by size_m within length_s: no point
  crept,       // the same with a small size_m: the point has the flag "creep"
  short_stop,  // a stop of length_s, too short to be averaged
  hole,        // no frames for length_s; meanwhile the axis moved by size_m
  jump,        // the encoder's count jumped by size_m
};

struct DwellEvent {
  DwellEventKind kind;
  std::int64_t time_ns = 0;  // start of the event
  double position_m = 0;     // at the start
  double size_m = 0, length_s = 0;
};

// A notice for each event: position, time after `start_ns`, figures; of many similar events the
// first ones and their number. Short and creeping stops outside the outermost points are reversals
// of the axis, and those next to a point are part of its stop: both are not reported.
Notices event_notices(const std::vector<DwellEvent>& events, const std::vector<Point>& points,
                      std::int64_t start_ns, double needed_s);

}  // namespace mdof::algo
