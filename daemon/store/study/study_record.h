// A stored sensitivity study: request, result and checkpoint.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "schema/study/study.h"

namespace mdof::store {

// The request of the study. It never changes.
struct StudyRecord {
  std::int64_t id = 0;  // the store assigns it
  std::string name;
  std::string plan_toml;      // the plan of a user, or the options of a preset
  std::string source;         // name of the file of the plan; "" for a preset
  std::string settings_toml;  // see tools/mdof/study/running/study_request.h
  std::int64_t seed = 0;
  std::optional<std::int64_t> trials_wanted;  // nullopt: the adaptive rule determines the number
  std::string fingerprint;                    // hash of the files and of the first trials
  std::string started_utc;
  std::string software_version;
};

// The result of the study when it ended or was interrupted.
struct StudyOutcome {
  StudyState state = StudyState::complete;
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  std::string ended_utc;
  std::string software_version;
  std::string figures_json;  // results of the study; equal studies have equal text
};

struct StudyCheckpoint {
  std::uint64_t trials = 0;
  std::string bytes;
};

}  // namespace mdof::store
