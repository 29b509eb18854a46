// Common base of all experiments of a plan.
#pragma once

#include <string>
#include <vector>

#include "algo/sensitivity/plan/draws.h"
#include "algo/sensitivity/plan/experiment.h"

namespace mdof::algo {

class PlanExperimentBase : public ScalableExperiment {
 public:
  explicit PlanExperimentBase(const StudyPlan& plan) {
    for (const auto& output : plan.outputs) outputs_.push_back(output.key);
    for (const auto& quantity : plan.quantities) {
      quantities_.push_back(quantity.name);
      sizes_.push_back(QuantileFunction(quantity.distribution).size());
      if (quantity.name == plan.binned_key)
        binned_ = {plan.binned_key, quantity.distribution.low, quantity.distribution.high,
                   plan.bins};
    }
  }

  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    run_all({first, step, n, {}, {}}, out);
  }
  void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    run_all({first, step, n, second, {}}, out);
  }
  void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                  std::size_t n, std::span<double* const> out) const override {
    run_all({first, step, n, {}, scale}, out);
  }

 protected:
  virtual void run_all(const DrawRequest& request, std::span<double* const> out) const = 0;
};

}  // namespace mdof::algo
