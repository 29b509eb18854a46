// A run as it was asked for.
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

// A run that ended before it was complete.
struct CutOffRun {
  std::int64_t id = 0;
  std::filesystem::path recording;
  EncoderDatum datum = {};    // of its positions
  std::string settings = {};  // as of PipelineOptions::settings_json()
};

struct RunRequest {
  std::string note;
  std::vector<double> targets_m;     // empty: recognised
  int repeats = 0;                   // 0: until stopped; else complete after so many, both ways
  Notices notices;                   // to be kept with the run
  std::optional<CutOffRun> resumes;  // goes on from there
  std::optional<HistoryEntry> action = std::nullopt;  // who asks for it
};

}  // namespace mdof::daemon
