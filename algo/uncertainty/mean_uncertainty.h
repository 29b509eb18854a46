// Standard uncertainty of a mean of readings that are not independent.
#pragma once

#include <cstddef>
#include <span>

namespace mdof::algo {

// `deviations`: n readings minus their mean, in the order of time; `sd`: their standard deviation.
// The function averages them to at most 256 means of equal length. It adds the autocovariances of
// these means up to the lag where they are lost in their own noise (initial positive sequence of
// pairs of lags: Geyer, Practical Markov chain Monte Carlo, Statist. Sci. 7 (1992) 473), and widens
// the sum because all lags share the error of the mean. The result is at least sd/√n. It covers
// noise whose correlation lasts at most a tenth of the readings. Slower noise looks constant within
// one dwell, and only the scatter between runs shows it.
double mean_uncertainty(std::span<const double> deviations, double sd);

}  // namespace mdof::algo
