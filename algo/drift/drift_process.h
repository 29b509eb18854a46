// Estimates drifts as functions of time, from repeated visits of the same places. The model of a
// reading:
//   y = error of the place + a t + g(t) + white noise;   drift: a t + g(t), 0 at the first visit
//
// g is a Gaussian process. It is the sum of a smooth part (Matérn, ν = 5/2) and of a random walk.
// The time in g is either the elapsed time or its logarithm, because a system that warms up drifts
// fastest at the start. g is approximated by cosines with independent amplitudes, whose variance is
// the spectral density of g (Solin, Särkkä 2020, doi:10.1007/s11222-019-09886-w).
//
// Each combination of the kind of time, the correlation time of the smooth part, and the sizes of
// both parts is a model. The weight of a model is its restricted likelihood (REML). The drift is
// the weighted mean of the models, and its covariance contains their differences.
//
// A variation that is the same at each visit of a place, such as one whose period is the duration
// of a run, cannot be distinguished from the error of the place.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {

inline constexpr double kLeastNoise2 = 1e-24;  // (1 pm)², for readings without noise

class DriftProcess {
 public:
  // `y`: visits × series. `noise2`: for each series the mean u² of its readings; the variance of
  // the white noise is at least this value. Requires freedom_of_noise() > 0.
  DriftProcess(const DriftDesign& design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  // Degrees of freedom of the white noise.
  static double freedom_of_noise(const DriftDesign& design);
  // Degrees of freedom of u(). The models have different u, which reduces the degrees of freedom
  // (GUM G.4.2, Eq. G.3), but not below 1.8 (kMostDisagreement).
  double freedom(Eigen::Index series) const { return freedom_(series); }
  // Returns the value of each term of the drift at a time; 0 at the first visit.
  Eigen::VectorXd terms(double time_s) const;
  // Drift of each series since the first visit, and its standard uncertainty, from terms().
  Eigen::VectorXd drift(const Eigen::VectorXd& terms) const { return mean_.transpose() * terms; }
  double u(Eigen::Index series, const Eigen::VectorXd& terms) const {
    return (root(series).transpose() * terms).norm();
  }
  // Lower triangular root R of the covariance of the terms. The elements of Rᵀ terms() are the
  // effects of independent parts of the uncertainty. Element i of all series belongs to the same
  // term.
  const Eigen::MatrixXd& root(Eigen::Index series) const {
    return roots_[static_cast<std::size_t>(series)];
  }

 private:
  struct Model {
    std::size_t clock;          // kind of time
    Eigen::VectorXd precision;  // 1 / variance of each term, relative to the white noise
    double log_variances;       // sum of the logarithms of the variances
    double log_prior;           // logarithm of the weight before the log is known
  };
  struct Products {  // sums over the visits, minus the means of the places, for one kind of time
    Eigen::MatrixXd terms, by_series;
    Eigen::MatrixXd mean_square;  // of the terms at the visits, without subtraction of a mean
  };
  // The fits of all models: the terms of each model (terms of its kind of time × series), the
  // variance of the white noise, and the weight (models × series).
  struct Fits {
    std::vector<Eigen::MatrixXd> terms;
    Eigen::MatrixXd noise2, weights;
  };
  static std::vector<Model> models();
  static Fits fits_of(const std::vector<Model>& models, const std::vector<Products>& products,
                      const Eigen::VectorXd& squares, double freedom);
  static Eigen::VectorXd in_all_terms(const Model& model, const Eigen::VectorXd& terms);
  std::vector<Products> products_of(const DriftDesign& design, const Eigen::MatrixXd& y) const;
  static Eigen::LLT<Eigen::MatrixXd> normal_equations(const Products& products, const Model& model);
  Eigen::VectorXd of_clock(std::size_t clock, double time_s) const;

  double begin_s_, length_s_;
  Eigen::VectorXd freedom_;
  Eigen::MatrixXd mean_;                // terms × series
  std::vector<Eigen::MatrixXd> roots_;  // of the covariance of the terms, for each series
};

}  // namespace mdof::algo
