// Reads the log of an axis that does not move. Calculates the means of the readings over equal time
// steps. These means are the input of the warm-up test (algo/drift/warm_up.h).
#pragma once

#include <optional>
#include <string>

#include "algo/drift/warm_up.h"
#include "daemon/measure/replay/replay.h"
#include "schema/base/progress.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

struct ParkedRequest {
  std::string log;                   // name of a file, or "-" for the standard input
  std::string rig_text, rig_source;  // empty rig_source: use the rig in the log
  // Drift limit for the readings of the probes and for the two straightness errors. Default:
  // limit_um_per_h in the table [drift] of the rig. If the rig has no such key, there is no limit.
  std::optional<double> limit_m_per_s;
  std::optional<double> angle_limit_rad_per_s;  // drift limit for the angles; default: no limit
  std::optional<double> window_s;  // length of a time window; default: a twelfth of the log
};

struct ParkedLog {
  Axis axis = Axis::x;
  double position_m = 0, length_s = 0;
  std::optional<double> limit_m_per_s;  // the requested limit or the limit of the rig
  bool simulated = false;
  bool declares = false;  // whether the rig declares an uncertainty
  // Readings of the probes, and errors of the moving body with the fixture as their reference
  // point. The first `probes` series are readings of probes; the other series are the five errors.
  std::size_t probes = 0;
  algo::ParkedReadings readings;
  Notices notices;
};

// Errors: those of replay(); the axis moved; the log is shorter than one window.
Result<ParkedLog> read_parked_log(const ParkedRequest& request,
                                  const ProgressCallback& progress = {});

}  // namespace mdof::daemon
