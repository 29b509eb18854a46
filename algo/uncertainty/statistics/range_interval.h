// The expanded uncertainty of a range, the highest of some deviations minus the lowest. Noise makes
// the measured range larger than the true one, by as much as all of it where the axis is perfect.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

// U such that 95 % of measured ranges R lie within U of the true range T: by inversion of
//   P(|range(t + change) - T| <= c(T)) = 95 %,  U = R - T where R - T = c(T),
// over the trials of the change. The true deviations t of the range T are the measured ones, those
// near an end brought together: clamped so that (R - T)/2 is cut off at both ends. So the bias is
// in U; where c(0) >= R, U is c(0) and the interval holds 0. U is at least c(R), of the deviations
// as measured: errors that are alike at neighbours vary less at a flat end than at a pointed one.
// And U is at least the 95 % point of what the two ends as measured change by: a neighbour that is
// nearly as high cuts the trials off below, which the true deviations need not do.
class RangeTrials {
 public:
  // `changes`: trial after trial, as many as `measured` each; at least one trial.
  RangeTrials(std::vector<double> measured, std::vector<double> changes);
  double U() const;
  double standard_deviation() const;  // of the ranges of the trials
  double root_mean_square() const;    // of what they differ by from the measured one

 private:
  // c(T)
  double distance_of_95_percent(double true_range) const;
  double distance_of_ends() const;
  std::vector<double> ranges(double cut) const;  // of each trial

  std::vector<double> measured_, changes_;
  double lowest_ = 0, highest_ = 0;
};

}  // namespace mdof::algo
