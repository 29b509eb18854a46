// Handles the flags of a point. A point has each flag at most once.
#pragma once

#include <algorithm>
#include <string>

#include "schema/point.h"

namespace mdof::algo {

inline bool has_flag(const Point& point, Flag flag, const std::string& channel = {}) {
  return std::find(point.flags.begin(), point.flags.end(), PointFlag{flag, channel}) !=
         point.flags.end();
}

inline void add_flag(Point& point, Flag flag, const std::string& channel = {}) {
  if (!has_flag(point, flag, channel)) point.flags.push_back({flag, channel});
}

}  // namespace mdof::algo
