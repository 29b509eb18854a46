// Messages to clients about new points of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/measure/run_request.h"
#include "schema/point.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// Messages for the topic run.event with the points from index `first_row`:
//   {"type": "points", "run", "axis", "offset", "reference", "u_covers", "points"}
// If one line cannot contain all points, several messages are returned. A continued run begins with
// many points. `points`: all points of the run until now; the fixture is the reference point of
// their errors.
std::vector<std::string> points_messages(std::int64_t run, const Rig& rig, Model model,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row);

// Message for a stop that is not near any target:
//   {"type": "left_out", "run", "axis", "position_mm", "code", "text"}
std::string left_out_message(std::int64_t run, Axis axis, double position_m);

// {"type": "started", "run", "axis"}
std::string started_message(std::int64_t run, Axis axis);
// {"type": "ended", "run", "axis", "state"}: the run to read and its state.
std::string ended_message(std::int64_t run, Axis axis, RunState state);
// {"type": "progress", "run", "axis", "points", "of", "done", "awaited_mm"}: number of points,
// number of requested points (null without repeats), and the expected next target (null without
// targets).
std::string progress_message(std::int64_t run, Axis axis, const RunRequest& request,
                             const std::vector<MeasuredPoint>& points);

}  // namespace mdof::daemon
