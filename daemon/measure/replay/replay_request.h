// A request for a replay. The command line and the RPC use the same names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/replay/replay.h"

namespace mdof::daemon {

struct ReplayRequest {
  std::string log;                   // a file, or "-" for CSV from the standard input
  ReplayLog::Descriptors opened;     // if the file is open already; open until the replay ends
  std::string rig_text, rig_source;  // empty source: the rig of the log
  std::string model, note;           // empty model: the model of the recording
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  bool remove_drift = false;  // false: as recorded
  bool on_the_fly = false;    // the axis moves all the time; the following options apply only then
  std::optional<double> interval_mm, bin_mm, from_mm, to_mm;
};

// Uses the options of the recording, overridden by the request. The run has everything but its id.
// Errors: those of replay(); a CSV log without a rig; an option out of range.
Result<Run> replay(const ReplayRequest& request, const ProgressCallback& progress = {});

}  // namespace mdof::daemon
