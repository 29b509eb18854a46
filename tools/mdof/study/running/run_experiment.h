// The experiment for plans with output_of = "run". A trial is a whole simulated run: the perturbed
// rig makes the samples, and the program evaluates them in the usual way, with the nominal rig.
#pragma once

#include <cstdint>
#include <memory>

#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::tools {

// Has the same errors as make_plan_experiment(). The experiment is thread-safe.
Result<std::unique_ptr<algo::ScalableExperiment>> make_run_experiment(const StudyPlan& plan);

// Error: the samples of this trial do not make a run; the message states the reason. Ok if they
// make a run, also if the run has no figures.
Status check_run_trial(const StudyPlan& plan, std::uint64_t trial);

}  // namespace mdof::tools
