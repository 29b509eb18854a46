// Whole simulated runs as trials, for plans with output_of = "run": the real pipeline evaluates
// samples of the perturbed rig with the nominal rig.
#pragma once

#include <cstdint>
#include <memory>

#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::tools {

// Refuses what make_plan_experiment() refuses. Thread-safe, as every Experiment.
Result<std::unique_ptr<algo::ScalableExperiment>> make_run_experiment(const StudyPlan& plan);

// Why a trial of such a plan gives no run. Ok if it gives a run, even a run without figures.
Status check_run_trial(const StudyPlan& plan, std::uint64_t trial);

}  // namespace mdof::tools
