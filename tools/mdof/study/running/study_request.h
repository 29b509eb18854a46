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

// Settings for making and summarising the trials of a plan or preset. Empty: the plan decides.
struct StudySettings {
  std::optional<std::uint64_t> trials;  // With an adaptive rule, the upper limit; none: no limit.
  std::optional<std::uint64_t> seed;    // < 2^63
  std::optional<double> coverage;
  std::optional<algo::AdaptiveTolerance> adaptive;
};
// Writes every setting that is present as TOML, and reads it.
std::string settings_toml(const StudySettings& settings);
Result<StudySettings> parse_settings(const std::string& toml);
// "EBX_urad=0.01": the numerical tolerance of one output, finite and above zero.
Status add_tolerance(const std::string& key_value, algo::AdaptiveTolerance& tolerance);

struct StudyRequest {
  std::string plan_toml;  // A plan, or the options of a preset (tools/mdof/study/preset.h).
  std::string source;     // File of the plan; its paths are relative to it. Empty: a preset.
  StudySettings settings;
};

// Ready to run. All settings have values; only the number of trials may be open.
struct Study {
  StudyRequest request;
  std::string name;
  std::optional<algo::SimulationOptions> preset;
  std::optional<StudyPlan> plan;
  std::unique_ptr<algo::Experiment> experiment;
  // The same object as `experiment`, if its parts can be scaled: only for a plan.
  const algo::ScalableExperiment* scalable = nullptr;

  bool slow() const { return plan && plan->whole_run; }  // A trial takes milliseconds.
};
Result<Study> make_study(StudyRequest request);

// Facts that must not change between the parts of a study, one line each in the format of
// sha256sum: the rigs and samples that the plan names, under these names, and the first trials,
// which change with the mathematics. Reads the files.
Result<std::string> fingerprint(const Study& study);
// Name of the first line of `now` that `before` does not contain; empty: no change.
std::string changed_since(const std::string& before, const std::string& now);
inline constexpr const char* kFirstTrials = "(first trials)";

}  // namespace mdof::tools
