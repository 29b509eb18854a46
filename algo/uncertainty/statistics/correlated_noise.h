// Correlated noise of the visits of a run. Visits that are close in time have similar errors.
// Therefore the means at neighbouring targets have similar errors.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algo/drift/slow_noise.h"

namespace mdof::algo {

// One visit of a target, for one named error.
struct NoisyVisit {
  std::size_t target = 0, pass = 0;
  double time_s = 0;
  double weight = 0;  // weight of the visit in the mean of its target
  // Residual of the error after the fit of repeatability.h. NaN: the target has no other visit with
  // the same approach.
  double residual = 0;
};

// Models the noise by all noises of slow_noises(). The probability of each noise is calculated from
// the restricted likelihood (REML) of the residuals, without their level in each pass. The variance
// of a figure is the mean over all noises, weighted with these probabilities, because a few visits
// do not determine the correlation well enough to choose one noise.
class CorrelatedNoise {
 public:
  // `visits`: in the order of time. `freedom`: degrees of freedom of the residuals, more than 0.
  // Assumes white noise if two times are equal, or if all residuals are 0.
  CorrelatedNoise(std::vector<NoisyVisit> visits, double freedom);

  // `square`: variance of a figure divided by its variance for independent visits. `freedom`:
  // degrees of freedom of the variance of the figure. `by_target`: change of the figure by one unit
  // of the mean at each target. The variances do not include the level of a pass.
  struct Widened {
    double square = 1, freedom = 0;
  };
  Widened of(std::span<const double> by_target) const;

 private:
  struct Model {
    SlowNoise noise;
    // Variance of a visit, square of the unit of the residuals.
    double probability = 1, variance = 0;
  };
  double fit(Model& model) const;  // sets model.variance; returns the logarithm of the likelihood
  double variance(const Model& model, std::span<const double> by_visit) const;

  std::vector<NoisyVisit> visits_;
  double freedom_ = 0;
  std::vector<Model> models_;
};

}  // namespace mdof::algo
