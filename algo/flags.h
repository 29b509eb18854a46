// Flags of a point, each at most once.
#pragma once

#include <algorithm>
#include <string>

#include "schema/point.h"

namespace mdof::algo {

inline void add_flag(Point& point, const std::string& flag) {
  if (std::find(point.flags.begin(), point.flags.end(), flag) == point.flags.end())
    point.flags.push_back(flag);
}

}  // namespace mdof::algo
