// Estimates a drift with correlated noise by generalised least squares (Aitken). The noise of one
// reading is the sum of white noise and slow noise, whose correlation decreases with exp(-|Δt|/τ)
// (Ornstein, Uhlenbeck). If τ is much larger than the length of the log, the slow noise is a random
// walk. A Kalman filter whitens the noise, so the calculation time is proportional to the number of
// visits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {

struct SlowNoise {
  double correlation_s = 0;  // τ
  double share = 0;  // variance of the slow noise / variance of one reading; 0: only white noise
};

// Returns noise models from white noise to a random walk, for visits at these times.
std::vector<SlowNoise> slow_noises(const std::vector<double>& time_s);

// Returns independent rows: each row minus its prediction from the rows before, divided by the
// standard deviation of this difference for readings of variance 1. `log_variances`: logarithm of
// the determinant of the covariance of `rows`, also for readings of variance 1.
Eigen::MatrixXd whitened(const std::vector<double>& time_s, const SlowNoise& noise,
                         const Eigen::MatrixXd& rows, double& log_variances);

struct WeighedFit {
  SlowNoise noise;
  bool solved = false;
  // The rows of `scores` are independent; their variance is the variance of one reading. A drift of
  // order n at the time t is the sum over k = 1 ... n of element k of root⁻ᵀ polynomials(t) times
  // score k.
  Eigen::MatrixXd scores;  // orders × series
  Eigen::MatrixXd root;    // orders × orders, upper
  // series × series: products of the whitened residuals of the fit of the highest order, summed
  // over the rows.
  Eigen::MatrixXd left;
  double log_determinants = 0;

  Eigen::VectorXd shapes(const Eigen::VectorXd& polynomials) const;
  // Returns -2 log(likelihood) of a series, up to a constant. It is the restricted likelihood
  // (REML; Patterson, Thompson 1971): the likelihood of the residuals after the fit of the places
  // and of the highest order.
  double minus_two_log_likelihood(Eigen::Index series, double freedom, double least_square) const;
};
WeighedFit weighed_fit(const DriftRows& rows, const SlowNoise& noise);

}  // namespace mdof::algo
