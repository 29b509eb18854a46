// The mean of a dwell's readings that a few spikes do not move.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mdof::algo {

struct RobustMean {
  double mean = 0;
  double sd = 0;  // of single readings that were kept
  double u = 0;   // standard uncertainty of the mean, see below
  std::size_t used = 0, rejected = 0;
};

// Readings further than 8 robust standard deviations (1.4826 · median absolute deviation) from the
// median are left out; where more than half of the readings are the same number, further than
// `coarse`. Sums have one order on every machine. u: mean_uncertainty(), for readings that are not
// independent (GUM 4.2.3).
// `readings` are finite; `scratch` is reused memory.
RobustMean robust_mean(std::span<const double> readings, double coarse,
                       std::vector<double>& scratch);

}  // namespace mdof::algo
