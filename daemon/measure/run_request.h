// The request for a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/encoder_datum.h"
#include "schema/history_entry.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

// A run that ended before it was complete, and that a new run can continue.
struct CutOffRun {
  std::int64_t id = 0;
  std::filesystem::path recording;
  EncoderDatum datum = {};    // datum of the recorded positions
  std::string settings = {};  // text of PipelineOptions::settings_json()
};

struct RunRequest {
  std::string note;
  std::vector<double> targets_m;  // empty: targets are recognised
  int repeats = 0;  // requested points for each target and approach; 0: the user ends the run
  Notices notices;  // notices that are stored with the run
  std::optional<CutOffRun> resumes;                   // the run that the new run continues
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
};

}  // namespace mdof::daemon
