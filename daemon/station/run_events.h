// What clients are told of a run's new points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/point.h"

namespace mdof::daemon {

// For run.event: {"type": "points", "run", "axis", "offset", "reference", "points"}. One message,
// or more where no line holds all: a run that goes on begins with many points.
std::vector<std::string> points_messages(std::int64_t run, const MovingAxis& moving,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row);

}  // namespace mdof::daemon
