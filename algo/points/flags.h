// Flags of a point, each at most once.
#pragma once

#include <algorithm>
#include <string>

#include "schema/point.h"

namespace mdof::algo {

inline bool has_flag(const Point& point, const std::string& flag) {
  return std::find(point.flags.begin(), point.flags.end(), flag) != point.flags.end();
}

inline void add_flag(Point& point, const std::string& flag) {
  if (!has_flag(point, flag)) point.flags.push_back(flag);
}

}  // namespace mdof::algo
