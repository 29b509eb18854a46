// Correlated noise of the visits of a run: visits that are close in time have similar errors, so
// the means at neighbouring targets have similar errors, too.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algo/drift/slow_noise.h"

namespace mdof::algo {

// One visit of a target, of one named error.
struct NoisyVisit {
  std::size_t target = 0, pass = 0;
  double time_s = 0;
  double weight = 0;  // of the visit in the mean of its target
  // Without its target and approach, and without the level of its pass. NaN: no other visit of it.
  double residual = 0;
};

// Each of slow_noises() has a probability by the restricted likelihood of the residuals, once their
// level in each pass is left out (REML). A figure has the mean of the variances by all of them:
// a few visits do not determine the correlation well enough to choose one.
class CorrelatedNoise {
 public:
  // `visits` in the order of time; `freedom`: degrees of freedom of their residuals, more than 0.
  // White noise alone where two times are not one after the other, or all residuals are 0.
  CorrelatedNoise(std::vector<NoisyVisit> visits, double freedom);

  // The variance of a figure over what it is if the visits are independent, and its degrees of
  // freedom. `by_target`: the change of the figure by a unit of the mean at each target. The level
  // of a pass is left out.
  struct Widened {
    double square = 1, freedom = 0;
  };
  Widened of(std::span<const double> by_target) const;

 private:
  struct Model {
    SlowNoise noise;
    double probability = 1, variance = 0;  // of a visit, any unit
  };
  double fit(Model& model) const;  // also the variance
  double variance(const Model& model, std::span<const double> by_visit) const;

  std::vector<NoisyVisit> visits_;
  double freedom_ = 0;
  std::vector<Model> models_;
};

}  // namespace mdof::algo
