// The drift of several series of readings that were taken together: which is significant, how much,
// and how well it is known.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/drift/drift_design.h"
#include "algo/drift/slow_noise.h"

namespace mdof::algo {

// Chance that any of the series of a fit without drift is given one.
inline constexpr double kDriftLevel = 0.01;

struct SeriesDrift {
  int order = 0;                    // the highest that is significant; 0: none
  double change = 0, u_change = 0;  // from the first visit to the last
  double range = 0;                 // highest - lowest at the visits
  double least_found = 0;           // a steady change of this size or more is significant
  bool steps = false;               // or steps from run to run, as likely (run_drift.h): it is left
  bool significant() const { return order > 0; }
};

// `y`: visits × series; `noise2`: of each series the mean u² of its readings, which the scatter of
// the residuals is not taken below. Noise may last from one visit to the next, and nobody knows for
// how long: a drift is significant only if it is by every noise (slow_noise.h) that the log makes
// nearly as likely as the likeliest; by that one it is estimated. Orders are tested from the
// highest down, each at kDriftLevel / (orders × series), with the variance that the highest leaves.
class DriftFit {
 public:
  DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2);

  const DriftDesign& design() const { return design_; }
  double freedom() const { return freedom_; }
  const std::vector<SeriesDrift>& series() const { return series_; }
  void take_for_steps(std::size_t series) { series_[series].steps = true; }
  // Of each series what is to be taken from a reading at that time, against the first visit; 0
  // where no drift is significant, or it is one of steps.
  Eigen::VectorXd drift(double time_s) const;
  // Where such drifts were taken from the readings before: by how much these may be wrong at each
  // of the times, as columns whose squares add, series × columns. Whether one was taken is seen:
  // its scores are 0. What lasts of the noise is in it, as the fit has taken a part of that, too.
  std::vector<Eigen::MatrixXd> parts(const std::vector<double>& time_s);

 private:
  struct Estimate {  // of one series
    Eigen::VectorXd scores;
    Eigen::MatrixXd root;
    double sd = 0;  // of a score
    SlowNoise noise;
    Eigen::MatrixXd of_waves, of_white;  // what these make of the scores
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
