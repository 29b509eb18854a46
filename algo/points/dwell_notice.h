// What happened to a log on the level of its stops that the points alone do not tell.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

enum class NoticeKind {
  creep,       // a stop that moved on by size_m within length_s: no point
  crept,       // the same, but little: the point has the flag "creep"
  short_stop,  // a stop of length_s, too short to be averaged
  hole,        // nothing came for length_s; the axis was displaced by size_m meanwhile
  jump,        // the encoder's count jumped by size_m
};

struct DwellNotice {
  NoticeKind kind;
  std::int64_t time_ns = 0;  // begin
  double position_m = 0;     // there
  double size_m = 0, length_s = 0;
};

// One sentence for each notice: position, time after `start_ns`, figures and remedy; of many of a
// kind the first ten and how many more. Short and creeping stops beyond the outermost points are
// turns of the axis, those beside a point are a part of its stop: neither is told.
std::vector<std::string> describe(const std::vector<DwellNotice>& notices,
                                  const std::vector<Point>& points, std::int64_t start_ns,
                                  double needed_s);

// At most ten of these, then how many more there are.
void append_summarised(std::vector<std::string>& to, const std::vector<std::string>& sentences,
                       const std::string& what);

}  // namespace mdof::algo
