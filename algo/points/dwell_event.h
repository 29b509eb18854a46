// What happened to a log on the level of its stops that the points alone do not show.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

enum class DwellEventKind {
  creep,       // a stop that moved on by size_m within length_s: no point
  crept,       // the same, but little: the point has the flag "creep"
  short_stop,  // a stop of length_s, too short to be averaged
  hole,        // nothing came for length_s; the axis was displaced by size_m meanwhile
  jump,        // the encoder's count jumped by size_m
};

struct DwellEvent {
  DwellEventKind kind;
  std::int64_t time_ns = 0;  // begin
  double position_m = 0;     // there
  double size_m = 0, length_s = 0;
};

// One notice for each event: position, time after `start_ns`, figures; of many alike the first ones
// and their number. Short and creeping stops beyond the outermost points are turns of the axis,
// those beside a point are a part of its stop: neither is reported.
Notices event_notices(const std::vector<DwellEvent>& events, const std::vector<Point>& points,
                      std::int64_t start_ns, double needed_s);

}  // namespace mdof::algo
