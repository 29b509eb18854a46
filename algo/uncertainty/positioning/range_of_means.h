// Trials of ranges that are calculated from repeated readings, as those of an imported file.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/uncertainty/statistics/range_interval.h"

namespace mdof::algo {

// Mean of n readings at a target with one approach.
struct MeanOfReadings {
  int target = 0;
  double value = 0;
  std::size_t n = 0;
  double squares = 0;  // sum of the squares of (reading - mean)
};

// Highest minus lowest mean. In each trial the means change by the scatter of the readings, whose
// variance is pooled over all means, and the readings of a target by one error with the standard
// uncertainty `u_target`, independent from target to target.
RangeTrials range_trials(const std::vector<MeanOfReadings>& means, double u_target);
// The largest absolute difference of the two approaches. `forward` and `reverse` have the same
// targets in the same order.
RangeTrials reversal_trials(const std::vector<MeanOfReadings>& forward,
                            const std::vector<MeanOfReadings>& reverse);

}  // namespace mdof::algo
