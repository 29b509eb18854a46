// Finds the drifts of several series of readings that were recorded at the same times, with their
// significance, size and uncertainty.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "algo/drift/drift_design.h"
#include "algo/drift/drift_process.h"
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
// A drift is significant if a fit of polynomials in time shows it. The noise of consecutive visits
// may be correlated over an unknown time. Several models of the noise (slow_noise.h) are therefore
// fitted. A drift is significant only if it is significant with every model that is nearly as
// likely as the likeliest model. Orders are tested from the highest to the lowest. The level of
// each test is kDriftLevel / (orders × series). Each test uses the residual variance of the fit of
// the highest order.
//
// A significant drift is then estimated as a function of time whose form is not assumed
// (drift_process.h).
class DriftFit {
 public:
  DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  const DriftDesign& design() const { return design_; }
  const std::vector<SeriesDrift>& series() const { return series_; }
  void mark_as_steps(std::size_t series) { series_[series].steps = true; }
  // Returns for each series the drift from the first visit to this time, which is subtracted from a
  // reading. 0 if no drift is significant, or if the drift may be steps.
  Eigen::VectorXd drift(double time_s) const;
  // Like drift(), but also for a drift that may be steps.
  Eigen::VectorXd course(double time_s) const;
  // Returns for each time the uncertainty of drift(): series × independent parts, whose squares
  // add. 0 for a series whose drift() is 0.
  std::vector<Eigen::MatrixXd> parts(const std::vector<double>& time_s) const;
  // Degrees of freedom of parts(); the fewest of all series whose drift() is not 0.
  double freedom() const;

 private:
  SeriesDrift tested(Eigen::Index series, const std::vector<WeighedFit>& fits, double noise2,
                     double critical_t) const;
  void describe_significant();
  bool removed(std::size_t series) const;
  Eigen::MatrixXd few_parts(const std::vector<double>& time_s) const;

  DriftDesign design_;
  double freedom_ = 0;  // of the fit of polynomials
  // Lower triangular root of the correlation matrix of the noise of the series.
  Eigen::MatrixXd correlation_;
  std::optional<DriftProcess> process_;  // only if a drift is significant
  std::vector<SeriesDrift> series_;
};

// Returns the value that |T| exceeds with this probability; T has Student's t distribution.
double critical_t(double probability, double freedom);

}  // namespace mdof::algo
