// The expanded uncertainty of a range, the highest of some deviations minus the lowest. Noise makes
// the measured range larger than the true one; if the axis is perfect, all of it is noise.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

// U such that 95 % of measured ranges R lie within U of the true range T, by inversion of
//   P(|range(t + change) - T| <= c(T)) = 95 %,  U = R - T where R - T = c(T),
// over the trials of the change. The true deviations t of the range T are the measured ones, of
// which (R - T)/2 is cut off at both ends. So U includes the bias; if c(0) >= R, U is c(0) and the
// interval contains 0. U is at least c(R) of the measured deviations: errors that are similar at
// neighbours vary less at a flat end than at a pointed one. U is also at least the 95 % point of
// the change of the difference of the two measured ends: a neighbour that is nearly as high limits
// how far the range falls in the trials, but the true deviations need not have one.
class RangeTrials {
 public:
  // `changes`: trial after trial, each with as many values as `measured`; at least one trial.
  RangeTrials(std::vector<double> measured, std::vector<double> changes);
  double U() const;
  double standard_deviation() const;  // standard deviation of the ranges of the trials
  double root_mean_square() const;    // rms of the ranges minus the measured range

 private:
  // c(T)
  double distance_at_95_percent(double true_range) const;
  double end_distance() const;
  std::vector<double> ranges(double cut) const;  // range of each trial

  std::vector<double> measured_, changes_;
  double lowest_ = 0, highest_ = 0;
};

}  // namespace mdof::algo
