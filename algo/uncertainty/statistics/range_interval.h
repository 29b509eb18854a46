// The expanded uncertainty of a range (highest minus lowest deviation). Noise makes the measured
// range larger than the true range. The measured range of a perfect axis is noise only.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

// 95 % of all measured ranges R lie within U of the true range T. The trials are random changes of
// the deviations. U is calculated by inversion over the trials:
//   P(|range(t + change) - T| <= c(T)) = 95 %,  U = R - T where R - T = c(T)
// The deviations t have the range T. They are the measured deviations with (R - T)/2 cut off at
// both ends. U includes the bias by noise. There are three limits:
//   - If c(0) >= R, U is c(0), and the interval R ± U contains 0.
//   - U is at least c(R). The reason is that the cut makes the ends of the deviations flat. If
//     neighbouring errors are similar, a flat end varies less than a pointed end.
//   - U is at least the 95 % point of the change of the difference between the highest and the
//     lowest measured deviation. The reason is that a neighbour which is nearly as high limits the
//     decrease of the range in the trials. The true deviations may have no such neighbour.
class RangeTrials {
 public:
  // `changes`: of all deviations in the first trial, then in the next trial, and so on; at least
  // one trial.
  RangeTrials(std::vector<double> measured, std::vector<double> changes);
  double U() const;
  double standard_deviation() const;  // of the ranges of the trials
  // Root mean square of (range of a trial - true range) for this true range.
  double root_mean_square(double true_range) const;

 private:
  // c(T)
  double distance_at_95_percent(double true_range) const;
  double end_distance() const;
  std::vector<double> ranges(double cut) const;  // of each trial; `cut` is cut off at both ends

  std::vector<double> measured_, changes_;
  double lowest_ = 0, highest_ = 0;
};

}  // namespace mdof::algo
