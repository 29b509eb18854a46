// The drifts of several series of readings that were taken together: their significance, size and
// uncertainty.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"
#include "algo/drift/slow_noise.h"

namespace mdof::algo {

// Probability that a fit finds a significant drift in any of its series, if no series has one.
inline constexpr double kDriftLevel = 0.01;

struct SeriesDrift {
  int order = 0;                    // the highest significant order; 0: no drift
  double change = 0, u_change = 0;  // from the first visit to the last
  double range = 0;                 // highest - lowest at the visits
  double least_found = 0;           // a steady change of this size or more is significant
  bool steps = false;  // steps from run to run are as likely (run_drift.h): not removed
  bool significant() const { return order > 0; }
};

// `y`: visits × series; `noise2`: for each series the mean u² of its readings, the lower limit of
// the variance from the residuals. Noise may be correlated from one visit to the next, for an
// unknown time. So a drift is significant only if it is significant with every model of the noise
// (slow_noise.h) that is nearly as likely as the likeliest one. The estimate is from the model with
// the largest uncertainty among those about as likely as the likeliest one; u_change is from the
// likeliest one. Orders are tested from the highest to the lowest, each at kDriftLevel / (orders ×
// series), with the residual variance of the highest order.
class DriftFit {
 public:
  DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  const DriftDesign& design() const { return design_; }
  double freedom() const { return freedom_; }
  const std::vector<SeriesDrift>& series() const { return series_; }
  void mark_as_steps(std::size_t series) { series_[series].steps = true; }
  // For each series the drift since the first visit, to be subtracted from a reading at this time;
  // 0 if no drift is significant, or if steps are as likely.
  Eigen::VectorXd drift(double time_s) const;
  // Uncertainty of readings from which such drifts were subtracted before, at each of the times:
  // series × columns, and the squares of the columns add. A subtracted drift is recognised by its
  // scores, which are 0. The slow noise is included, because the fit has removed a part of it, too.
  std::vector<Eigen::MatrixXd> parts(const std::vector<double>& time_s);

 private:
  struct Estimate {  // for one series
    Eigen::VectorXd scores;
    Eigen::MatrixXd root;
    double sd = 0;  // sd of a score
    SlowNoise noise;
    Eigen::MatrixXd of_waves, of_white;  // their effects on the scores
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
  Eigen::MatrixXd correlation_;  // lower root of the correlation of the series' noise
  std::vector<Estimate> estimates_;
  std::vector<SeriesDrift> series_;
};

// t that |T| of so many degrees of freedom exceeds with this probability.
double critical_t(double probability, double freedom);

}  // namespace mdof::algo
