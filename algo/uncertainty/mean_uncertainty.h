// Standard uncertainty of a mean of readings that are not independent.
#pragma once

#include <cstddef>
#include <span>

namespace mdof::algo {

// `deviations`: n readings minus their mean, in the order of time. `sd`: standard deviation of the
// readings. Steps of the calculation:
//   1. Average the deviations in at most 256 groups of equal length.
//   2. Add the autocovariances of the group means, up to the lag where they are smaller than their
//     noise (initial positive sequence of pairs of lags: Geyer, Practical Markov chain Monte Carlo,
//     Statist. Sci. 7 (1992) 473).
//   3. Enlarge the sum, because the mean of the readings was subtracted from all deviations.
// The result is at least sd/√n. It includes noise with a correlation time of at most a tenth of the
// duration of the readings. Slower noise is nearly constant within one dwell; only the scatter
// between runs shows it.
double mean_uncertainty(std::span<const double> deviations, double sd);

}  // namespace mdof::algo
