// Finds the drifts of several series of readings that were recorded at the same times, with their
// significance, size and uncertainty.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"
#include "algo/drift/slow_noise.h"

namespace mdof::algo {

// Probability that a fit finds a significant drift in at least one series although no series has a
// drift.
inline constexpr double kDriftLevel = 0.01;

struct SeriesDrift {
  int order = 0;                    // the highest significant order; 0: no drift
  double change = 0, u_change = 0;  // from the first visit to the last; standard uncertainty
  double range = 0;                 // highest minus lowest drift at the visits
  double least_found = 0;           // smallest steady change that would be significant
  bool steps = false;               // the change may be steps (run_drift.h), so it is not removed
  bool significant() const { return order > 0; }
};

// `y`: visits × series. `noise2`: for each series the mean u² of its readings; the variance from
// the residuals is at least this value.
//
// The noise of consecutive visits may be correlated over an unknown time. Several models of the
// noise (slow_noise.h) are therefore fitted:
// - A drift is significant only if it is significant with every model that is nearly as likely as
//   the likeliest model.
// - The drift is estimated with the model that has the largest uncertainty among the models that
//   are about as likely as the likeliest model.
// - u_change is from the likeliest model.
//
// Orders are tested from the highest to the lowest. The level of each test is kDriftLevel / (orders
// × series). Each test uses the residual variance of the fit of the highest order.
class DriftFit {
 public:
  DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  const DriftDesign& design() const { return design_; }
  double freedom() const { return freedom_; }
  const std::vector<SeriesDrift>& series() const { return series_; }
  void mark_as_steps(std::size_t series) { series_[series].steps = true; }
  // Returns for each series the drift from the first visit to this time, which is subtracted from a
  // reading. 0 if no drift is significant, or if the drift may be steps.
  Eigen::VectorXd drift(double time_s) const;
  // Returns for each time the uncertainty of readings from which drift() was subtracted before the
  // fit: series × independent parts, whose squares add. A series whose drift was subtracted is
  // recognised by its scores, which are 0. The slow noise is included, because the subtracted drift
  // contains a part of the slow noise.
  std::vector<Eigen::MatrixXd> parts(const std::vector<double>& time_s);

 private:
  struct Estimate {  // for one series
    Eigen::VectorXd scores;
    Eigen::MatrixXd root;
    double sd = 0;  // sd of a score
    SlowNoise noise;
    // Effects of the waves and of the white noise on the scores.
    Eigen::MatrixXd of_waves, of_white;
  };
  void estimate(Eigen::Index series, const std::vector<WeighedFit>& fits, double noise2,
                double critical_t);
  void split_noise(Estimate& of) const;
  Eigen::VectorXd waves(const Estimate& of, double time_s) const;
  SeriesDrift described(const Estimate& of, int order) const;
  Eigen::VectorXd shapes(const Estimate& of, double time_s) const;
  bool taken(std::size_t series) const;

  DriftDesign design_;
  double freedom_ = 0;
  // Lower triangular root of the correlation matrix of the noise of the series.
  Eigen::MatrixXd correlation_;
  std::vector<Estimate> estimates_;
  std::vector<SeriesDrift> series_;
};

// Returns the value that |T| exceeds with this probability; T has Student's t distribution.
double critical_t(double probability, double freedom);

}  // namespace mdof::algo
