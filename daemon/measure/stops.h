// Finds the stops of the axis in a recorded log. The stops are not solved. Calibrations use these
// functions.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"
#include "schema/sample.h"

namespace mdof::daemon {

struct LogStops {
  // Readings in the order of the probes of the rig; an unusable reading is NaN.
  std::vector<Point> stops;
  std::vector<Unit> units;  // units of the probes in the log
  std::string sha256;       // SHA-256 of the log
  std::string started_utc;  // start time of a recording, otherwise empty
  Notices notices;
};

// `axis`: axis of the log. The rig may be for another axis. A reading is unusable if the probe had
// a sudden step, has a constant reading (frozen) or was at the end of its range. Errors: those of
// the driver; the log is for another axis; the column of the encoder or of a probe is missing; no
// stop is long enough.
Result<LogStops> read_stops(const std::string& log, Axis axis, const Rig& rig);

}  // namespace mdof::daemon
