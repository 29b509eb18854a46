// A recorded log -> the stops of its axis, without solving anything: what a calibration takes.
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
  std::vector<Point> stops;  // probes in the order of the rig; those not to be used are NaN
  std::vector<Unit> units;   // in which the log has the probes
  std::string sha256;        // of the log
  std::string started_utc;   // of a recording, else empty
  Notices notices;
};

// The log is of `axis`, which need not be the rig's. A reading that spiked, stepped, froze or was
// at the end of its range is not to be used. Errors: those of the driver; a log of another axis, or
// without a column of the encoder or of one of the rig's probes; no stop long enough.
Result<LogStops> read_stops(const std::string& log, Axis axis, const Rig& rig);

}  // namespace mdof::daemon
