// A request for a replay, from the command line or from the RPC method.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/replay/replay.h"

namespace mdof::daemon {

struct ReplayRequest {
  std::string log;                // a file, or "-" for CSV from the standard input
  ReplayLog::Descriptors opened;  // descriptors if the file is open already; the caller keeps them
                                  // open during the replay
  std::string rig_text, rig_source;  // empty rig_source: use the rig in the log
  std::string model, note;           // empty model: use the model of the recording
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  bool remove_drift = false;  // false: use the option of the recording
  // true: the axis moves all the time; only then the following four options apply.
  bool on_the_fly = false;
  std::optional<double> interval_mm, bin_mm, from_mm, to_mm;
};

// Calculates a run with the options of the recording; options of the request override these
// options. The run has no id yet. Errors: those of replay() in replay.h; a CSV log has no rig; an
// option is out of range.
Result<Run> replay(const ReplayRequest& request, const ProgressCallback& progress = {});

}  // namespace mdof::daemon
