// A stored sensitivity study: its request, its result and its progress.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "schema/study/study.h"

namespace mdof::store {

// The request. It never changes.
struct StudyRecord {
  std::int64_t id = 0;  // assigned by the store
  std::string name;
  std::string plan_toml;      // a user's plan, or the options of a preset
  std::string source;         // file of the plan; "" for a preset
  std::string settings_toml;  // see tools/mdof/study/running/study_request.h
  std::int64_t seed = 0;
  std::optional<std::int64_t> trials_wanted;  // nullopt: determined by the adaptive rule
  std::string fingerprint;                    // hash of its files and first trials
  std::string started_utc;
  std::string software_version;
};

// The result when the study ended or was interrupted.
struct StudyOutcome {
  StudyState state = StudyState::complete;
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  std::string ended_utc;
  std::string software_version;
  std::string figures_json;  // figures without data that differ between equal studies
};

struct StudyCheckpoint {
  std::uint64_t trials = 0;
  std::string bytes;
};

}  // namespace mdof::store
