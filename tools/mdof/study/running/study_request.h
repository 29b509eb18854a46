// A sensitivity study as it was asked for, and the experiment that it makes.
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

// How the trials of a plan or preset are made and summed up. Empty: as the plan says.
struct StudySettings {
  std::optional<std::uint64_t> trials;  // with an adaptive rule: at most; none: no limit
  std::optional<std::uint64_t> seed;    // < 2^63
  std::optional<double> coverage;
  std::optional<algo::AdaptiveTolerance> adaptive;
};
// TOML and back, every setting that is there.
std::string settings_toml(const StudySettings& settings);
Result<StudySettings> parse_settings(const std::string& toml);
// "EBX_urad=0.01": a numerical tolerance, finite and above zero, for one output.
Status add_tolerance(const std::string& key_value, algo::AdaptiveTolerance& tolerance);

struct StudyRequest {
  std::string plan_toml;  // a plan, or a preset's options (tools/mdof/study/preset.h)
  std::string source;     // file of the plan, to which its paths are relative; "": a preset
  StudySettings settings;
};

// Ready to run. Its settings are in full; only the number of trials may be open.
struct Study {
  StudyRequest request;
  std::string name;
  std::optional<algo::SimulationOptions> preset;
  std::optional<StudyPlan> plan;
  std::unique_ptr<algo::Experiment> experiment;
  // The same object, where it can be taken apart: of a plan.
  const algo::ScalableExperiment* scalable = nullptr;

  bool slow() const { return plan && plan->whole_run; }  // milliseconds a trial
};
Result<Study> make_study(StudyRequest request);

// What must be the same for a study to be continued, a line each, as sha256sum writes them: the
// rigs and samples that the plan names, by those names, and the first trials, which differ where
// the mathematics has changed. Reads the files.
Result<std::string> fingerprint(const Study& study);
// The name of the first line of `now` that is not in `before`; "": the same.
std::string changed_since(const std::string& before, const std::string& now);
inline constexpr const char* kFirstTrials = "(first trials)";

}  // namespace mdof::tools
