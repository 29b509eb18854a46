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
  double weight = 0;  // weight of the visit in the mean of its target
  // Error minus the effects of its target with approach, and of its pass. NaN: the only visit of
  // the target from this side.
  double residual = 0;
};

// Each of slow_noises() has a probability by the restricted likelihood of the residuals, once their
// level in each pass is left out (REML). A figure has the mean of the variances by all of them:
// a few visits do not determine the correlation well enough to choose one.
class CorrelatedNoise {
 public:
  // `visits` in the order of time; `freedom`: degrees of freedom of their residuals, more than 0.
  // Assumes white noise if two times are equal, or if all residuals are 0.
  CorrelatedNoise(std::vector<NoisyVisit> visits, double freedom);

  // `square`: ratio of the variance of a figure to its variance with independent visits; `freedom`:
  // its degrees of freedom. `by_target`: change of the figure by a unit of the mean at each target.
  // The level of a pass is left out.
  struct Widened {
    double square = 1, freedom = 0;
  };
  Widened of(std::span<const double> by_target) const;

 private:
  struct Model {
    SlowNoise noise;
    double probability = 1, variance = 0;  // variance of a visit, any unit
  };
  double fit(Model& model) const;  // sets model.variance; returns the log of the likelihood
  double variance(const Model& model, std::span<const double> by_visit) const;

  std::vector<NoisyVisit> visits_;
  double freedom_ = 0;
  std::vector<Model> models_;
};

}  // namespace mdof::algo
