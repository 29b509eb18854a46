// A requested sensitivity study, and the experiment that it defines.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "algo/sensitivity/adaptive.h"
#include "algo/sensitivity/plan/experiment.h"
#include "algo/sensitivity/simulation.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::tools {

// Settings of a study. If a setting is nullopt, the plan or preset decides.
struct StudySettings {
  // With an adaptive rule: largest number of trials; nullopt: no limit.
  std::optional<std::uint64_t> trials;
  std::optional<std::uint64_t> seed;  // < 2^63
  std::optional<double> coverage;
  std::optional<algo::AdaptiveTolerance> adaptive;
};
// Writes the settings that are not nullopt as TOML; parse_settings() reads them.
std::string settings_toml(const StudySettings& settings);
Result<StudySettings> parse_settings(const std::string& toml);
// Reads the numerical tolerance of one output, for example "EBX_urad=0.01", and adds it. The
// tolerance must be finite and above 0.
Status add_tolerance(const std::string& key_value, algo::AdaptiveTolerance& tolerance);

struct StudyRequest {
  std::string plan_toml;  // A plan, or the options of a preset (tools/mdof/study/preset.h).
  // File of the plan; the paths in a plan are relative to this file. Empty: a preset.
  std::string source;
  StudySettings settings;
};

// A study that is ready to run. All settings have values, except the number of trials with an
// adaptive rule.
struct Study {
  StudyRequest request;
  std::string name;
  std::optional<algo::SimulationOptions> preset;
  std::optional<StudyPlan> plan;
  std::unique_ptr<algo::Experiment> experiment;
  // The same object as `experiment` if the study has a plan, otherwise nullptr.
  const algo::ScalableExperiment* scalable = nullptr;

  bool slow() const { return plan && plan->whole_run; }  // A trial takes milliseconds.
};
Result<Study> make_study(StudyRequest request);

// A text that must be the same when a study is continued. It has one line in the format of
// sha256sum for each rig or sample file that the plan names, and one line for the results of the
// first trials, which change if the mathematics of mdof changes. Reads the files.
Result<std::string> fingerprint(const Study& study);
// The name (file or kFirstTrials) in the first line of `now` that `before` does not contain; empty:
// nothing has changed.
std::string changed_since(const std::string& before, const std::string& now);
inline constexpr const char* kFirstTrials = "(first trials)";

}  // namespace mdof::tools
