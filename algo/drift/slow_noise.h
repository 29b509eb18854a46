// Estimates a drift with correlated noise by generalised least squares (Aitken). The noise of one
// reading is the sum of white noise and slow noise, whose correlation decreases with exp(-|Δt|/τ)
// (Ornstein, Uhlenbeck). If τ is much larger than the length of the log, it is a random walk. The
// innovations of a Kalman filter whiten both; the time is proportional to the number of visits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {

struct SlowNoise {
  double correlation_s = 0;  // τ
  double share = 0;          // share of the variance of one reading; 0: only white noise
};

// Candidates from white noise to a random walk, for visits at these times.
std::vector<SlowNoise> slow_noises(const std::vector<double>& time_s);

// Each row minus its prediction from the rows before, scaled: independent rows of variance 1.
// `log_variances`: logarithm of the determinant of the covariance of `rows`.
Eigen::MatrixXd whitened(const std::vector<double>& time_s, const SlowNoise& noise,
                         const Eigen::MatrixXd& rows, double& log_variances);

struct WeighedFit {
  SlowNoise noise;
  bool solved = false;
  // The rows are independent and have the variance of one reading. A drift of order n is (root⁻ᵀ
  // polynomials(t)) · scores, with the first n of both.
  Eigen::MatrixXd scores;  // orders × series
  Eigen::MatrixXd root;    // orders × orders, upper
  Eigen::MatrixXd left;  // series × series: products of the whitened residuals of the highest order
  double log_determinants = 0;

  Eigen::VectorXd shapes(const Eigen::VectorXd& polynomials) const;
  // -2 log of the likelihood of a series, without a constant, restricted to the residuals of its
  // places and of the highest order (REML; Patterson, Thompson 1971).
  double unlikeliness(Eigen::Index series, double freedom, double least_square) const;
};
WeighedFit weighed_fit(const DriftRows& rows, const SlowNoise& noise);

}  // namespace mdof::algo
