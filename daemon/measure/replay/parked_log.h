// A log of a parked axis -> means of its readings over equal time steps, the input of the warm-up
// test (algo/drift/warm_up.h).
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
  std::string log;                   // a file, or "-"
  std::string rig_text, rig_source;  // empty source: the rig of the log
  // Drift limit for the readings of the probes and the two straightness errors. Default: the rig's
  // [drift] limit_um_per_h; without it there is no limit.
  std::optional<double> limit_m_per_s;
  std::optional<double> angle_limit_rad_per_s;  // likewise for the angles; default: no limit
  std::optional<double> window_s;               // default: a twelfth of the log
};

struct ParkedLog {
  Axis axis = Axis::x;
  double position_m = 0, length_s = 0;
  std::optional<double> limit_m_per_s;  // the limit that is used
  bool simulated = false;
  bool declares = false;   // whether the rig declares an uncertainty
  std::size_t probes = 0;  // number of the first series that are probes; the others are the five
                           // errors
  algo::ParkedReadings readings;  // of the probes, and errors of the moving body at the fixture
  Notices notices;
};

// Errors: those of replay(); the axis moved; the log is shorter than one window.
Result<ParkedLog> read_parked_log(const ParkedRequest& request,
                                  const ProgressCallback& progress = {});

}  // namespace mdof::daemon
