// What somebody wants replayed, and how: the same words on the command line and on the RPC.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/replay/replay.h"

namespace mdof::daemon {

struct ReplayRequest {
  std::string log;                   // a file, or "-" for CSV from the standard input
  ReplayLog::Descriptors opened;     // where it is open already, for as long as the replay lasts
  std::string rig_text, rig_source;  // source empty: the log's own
  std::string model, note;           // model empty: as it was measured
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  bool remove_drift = false;  // false: as it was measured
  bool on_the_fly = false;    // the axis moves all the time; the rest only then
  std::optional<double> interval_mm, bin_mm, from_mm, to_mm;
};

// As mdofd measured what it recorded, but for what the request says. The run has all but its id.
// Errors: replay()'s; a CSV log without a rig; an option that is out of its range.
Result<Run> replay(const ReplayRequest& request, const ProgressCallback& progress = {});

}  // namespace mdof::daemon
