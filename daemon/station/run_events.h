// Messages to clients about new points of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Messages for run.event with the points from `first_row` on: {"type": "points", "run", "axis",
// "offset", "reference", "u_covers", "points"}. There are several messages if one line cannot
// contain all points: a continued run begins with many. `points` are all points of the run so far,
// stated at the fixture.
std::vector<std::string> points_messages(std::int64_t run, const Rig& rig, Model model,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row);

// {"type": "left_out", "run", "axis", "position_mm", "code", "text"}: a stop that is not near any
// target.
std::string left_out_message(std::int64_t run, Axis axis, double position_m);

}  // namespace mdof::daemon
