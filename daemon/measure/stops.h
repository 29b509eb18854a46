// A recorded log -> the stops of its axis, not solved. Calibrations use them.
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
  std::vector<Point> stops;  // probes in the order of the rig; unusable readings are NaN
  std::vector<Unit> units;   // units of the probes in the log
  std::string sha256;        // SHA-256 of the log
  std::string started_utc;   // start time of a recording, otherwise empty
  Notices notices;
};

// The log is of `axis`, which may differ from the rig's axis. A reading is unusable if its probe
// has made a step, is frozen or was at the end of its range. Errors: those of the driver; a log of
// another axis; a missing column of the encoder or of a probe; no stop that is long enough.
Result<LogStops> read_stops(const std::string& log, Axis axis, const Rig& rig);

}  // namespace mdof::daemon
