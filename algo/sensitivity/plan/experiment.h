// The experiment of a user's plan (PLAN.md). In each trial mdof draws the quantities, calculates
// the readings of the perturbed rig, solves these readings with the nominal rig, and compares the
// solved errors with the true errors.
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
  const std::vector<std::string>& quantities() const { return quantities_; }
  // Size of each tolerance in the unit of its name: half width, standard deviation, ... (PLAN.md).
  const std::vector<double>& sizes() const { return sizes_; }
  // As run(), but with the values of quantity q multiplied by scale[q]. If all scale[q] are 1, the
  // results have the bits of run().
  virtual void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                          std::size_t n, std::span<double* const> out) const = 0;
  // Names and numbers of one trial. The names contain no star. Values are in the unit of the name.
  virtual std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const = 0;

 protected:
  std::vector<std::string> quantities_;
  std::vector<double> sizes_;
};

// Errors state the file and the key of the plan: a rig that does not determine all errors or does
// not fit the model; a matrix that is not positive definite; an output or effect that the forward
// model does not have. For plans with whole_run see tools/mdof/study/running/run_experiment.h.
Result<std::unique_ptr<ScalableExperiment>> make_plan_experiment(const StudyPlan& plan);

// The experiment of the same plan with the rig of [compare] and the same random numbers.
// plan.compare must be set.
Result<std::unique_ptr<ScalableExperiment>> make_compared_experiment(const StudyPlan& plan);

}  // namespace mdof::algo
