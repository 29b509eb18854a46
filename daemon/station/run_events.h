// What is announced to clients of a run's new points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// For run.event, of the points from `first_row` on: {"type": "points", "run", "axis", "offset",
// "reference", "u_covers", "points"}. One message, or more where no line holds all: a run that goes
// on begins with many points. `points` are all of the run so far, stated at the fixture.
std::vector<std::string> points_messages(std::int64_t run, const Rig& rig, Model model,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row);

// {"type": "left_out", "run", "axis", "position_mm", "code", "text"}: a stop that is near no
// target.
std::string left_out_message(std::int64_t run, Axis axis, double position_m);

}  // namespace mdof::daemon
