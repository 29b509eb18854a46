// A trial of a user's plan: draw the quantities, see what the perturbed rig reads, solve as the
// nominal rig would, compare with the truth. Described in PLAN.md.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

// One whose quantities can be made larger and smaller, for the allocation of tolerances.
class ScalableExperiment : public CausalExperiment {
 public:
  // Names of the quantities as the plan has them, in its order.
  virtual const std::vector<std::string>& quantities() const = 0;
  // The size of each tolerance in the unit of its name: half width, standard deviation, ... as
  // PLAN.md says.
  virtual const std::vector<double>& sizes() const = 0;
  // As run(), each value of quantity q times scale[q]; all 1: the same bits as run().
  virtual void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                          std::size_t n, std::span<double* const> out) const = 0;
  // What was drawn in one trial: names without star and values in their unit.
  virtual std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const = 0;
};

// Refuses, with the plan's file and key: a rig that cannot see an error or does not fit the model,
// a matrix that is not positive definite, an output or effect that the forward model has not.
// For plans with whole_run see tools/mdof/study/running/run_experiment.h.
Result<std::unique_ptr<ScalableExperiment>> make_plan_experiment(const StudyPlan& plan);

// The same plan and random numbers on the rig of [compare]; to be called where plan.compare is set.
Result<std::unique_ptr<ScalableExperiment>> make_compared_experiment(const StudyPlan& plan);

}  // namespace mdof::algo
