// The drift of several series of readings that were taken together: which is significant, how much,
// and how well it is known.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {

// Chance that any of the series of a fit without drift is given one.
inline constexpr double kDriftLevel = 0.01;

struct SeriesDrift {
  int order = 0;                    // of the polynomial in time; 0: none is significant
  double change = 0, u_change = 0;  // from the first visit to the last
  double range = 0;                 // highest - lowest at the visits
  double least_found = 0;           // a steady change of this size or more is significant
  bool steps = false;               // or steps from run to run, as likely (run_drift.h): it is left
  bool significant() const { return order > 0; }
};

// `y`: visits × series; `noise2`: of each series the mean u² of its readings, which the scatter of
// the residuals is not taken below. Orders are tested from the highest down, each at kDriftLevel /
// (orders × series), with the variance that the highest leaves; where its residuals follow each
// other, as of a drift that no polynomial meets, it is taken larger, by (1 + r)/(1 - r).
class DriftFit {
 public:
  DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  const DriftDesign& design() const { return design_; }
  const std::vector<SeriesDrift>& series() const { return series_; }
  void take_for_steps(std::size_t series) { series_[series].steps = true; }
  // Of each series what is to be taken from a reading at that time, and its covariance: 0 where no
  // drift is significant, or it is one of steps.
  Eigen::VectorXd drift(double time_s) const;
  Eigen::MatrixXd covariance(double time_s) const;

 private:
  SeriesDrift tested(Eigen::Index series, double critical_t) const;
  int removed_order(Eigen::Index series) const;

  DriftDesign design_;
  Eigen::MatrixXd scores_, noise_;  // orders × series; covariance of one reading of each series
  std::vector<SeriesDrift> series_;
};

// t that |T| of so many degrees of freedom exceeds with this probability.
double critical_t(double probability, double freedom);

}  // namespace mdof::algo
