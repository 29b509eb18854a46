// A drift among noise that lasts from one visit to the next: generalised least squares (Aitken)
// with the noise of one reading as the sum of a white one and a slow one, whose correlation falls
// with exp(-|Δt|/τ) (Ornstein, Uhlenbeck); τ far over the length of the log makes it a random walk.
// Both are whitened by the innovations of a Kalman filter, in a time that grows with the visits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {

struct SlowNoise {
  double correlation_s = 0;  // τ
  double share = 0;          // of the variance of one reading; 0: all of it is white
};

// From white noise to a random walk, for visits that are so far apart.
std::vector<SlowNoise> slow_noises(const std::vector<double>& time_s);

// Rows without what the rows before predict of them, of variance 1 and independent of each other.
// `log_variances`: what the logarithm of the determinant of their covariance was.
Eigen::MatrixXd whitened(const std::vector<double>& time_s, const SlowNoise& noise,
                         const Eigen::MatrixXd& rows, double& log_variances);

struct WeighedFit {
  SlowNoise noise;
  bool solved = false;
  // The rows are independent of each other and have the variance of one reading: a drift of order
  // n is (root⁻ᵀ polynomials(t)) · scores, the first n of both.
  Eigen::MatrixXd scores;  // orders × series
  Eigen::MatrixXd root;    // orders × orders, upper
  Eigen::MatrixXd left;    // series × series: products of what the highest order leaves, whitened
  double log_determinants = 0;

  Eigen::VectorXd shapes(const Eigen::VectorXd& polynomials) const;
  // -2 log of the likelihood of a series, restricted to what its places and the highest order leave
  // (REML; Patterson, Thompson 1971), but for a constant.
  double unlikeliness(Eigen::Index series, double freedom, double least_square) const;
};
WeighedFit weighed_fit(const DriftRows& rows, const SlowNoise& noise);

}  // namespace mdof::algo
