// The mean of the readings of a dwell, calculated so that a few spikes do not change it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mdof::algo {

struct RobustMean {
  double mean = 0;
  double sd = 0;  // sd of the kept single readings
  double u = 0;   // standard uncertainty of the mean, see below
  std::size_t used = 0, rejected = 0;
};

// A reading is left out if its distance from the median is above 8 robust standard deviations
// (1.4826 · median absolute deviation). If more than half of the readings are the same number, the
// limit is `coarse`. Sums have the same order on every machine. u is mean_uncertainty() for
// correlated readings (GUM 4.2.3). `readings` are finite; `scratch` is reused memory.
RobustMean robust_mean(std::span<const double> readings, double coarse,
                       std::vector<double>& scratch);

}  // namespace mdof::algo
