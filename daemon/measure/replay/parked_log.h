// A log of a parked axis -> the means of its readings over equal steps of time: what the warm-up
// test (algo/drift/warm_up.h) takes.
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
  std::string rig_text, rig_source;  // source empty: the log's own
  // Most that the readings of a probe and the two straightness errors may drift; none: the rig's
  // [drift] limit_um_per_h, and where it has none, they have none.
  std::optional<double> limit_m_per_s;
  std::optional<double> angle_limit_rad_per_s;  // likewise of the angles; none: they have none
  std::optional<double> window_s;               // none: a twelfth of the log
};

struct ParkedLog {
  Axis axis = Axis::x;
  double position_m = 0, length_s = 0;
  std::optional<double> limit_m_per_s;  // that holds
  bool simulated = false;
  bool declares = false;          // the rig, an uncertainty
  std::size_t probes = 0;         // the first series; the rest are the five errors
  algo::ParkedReadings readings;  // of the body that moves, at the fixture
  Notices notices;
};

// Errors: as replay(); the axis moved; the log is too short for one window.
Result<ParkedLog> read_parked_log(const ParkedRequest& request,
                                  const ProgressCallback& progress = {});

}  // namespace mdof::daemon
