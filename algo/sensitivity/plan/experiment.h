// A trial of a user's plan: draw the quantities, calculate the readings of the perturbed rig, solve
// them with the nominal rig, compare with the truth. PLAN.md describes it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

// An experiment whose quantities can be scaled, for the allocation of tolerances.
class ScalableExperiment : public CausalExperiment {
 public:
  // Names of the quantities, in the order of the plan.
  virtual const std::vector<std::string>& quantities() const = 0;
  // Size of each tolerance in the unit of its name: half width, standard deviation, ... (PLAN.md).
  virtual const std::vector<double>& sizes() const = 0;
  // Like run(), with each value of quantity q times scale[q]; if all are 1, the bits are those of
  // run().
  virtual void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                          std::size_t n, std::span<double* const> out) const = 0;
  // Numbers drawn in one trial: names without star, and values in their unit.
  virtual std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const = 0;
};

// Errors, with the plan's file and key: a rig that does not determine all errors or does not fit
// the model, a matrix that is not positive definite, an output or effect that the forward model
// does not have. For plans with whole_run see tools/mdof/study/running/run_experiment.h.
Result<std::unique_ptr<ScalableExperiment>> make_plan_experiment(const StudyPlan& plan);

// The same plan and random numbers with the rig of [compare]; requires plan.compare.
Result<std::unique_ptr<ScalableExperiment>> make_compared_experiment(const StudyPlan& plan);

}  // namespace mdof::algo
