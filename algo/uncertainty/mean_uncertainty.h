// Standard uncertainty of a mean of readings that are not independent.
#pragma once

#include <cstddef>
#include <span>

namespace mdof::algo {

// `deviations` of n readings from their mean, in the order of time, and their `sd`. Their
// autocorrelation is summed up to where it is lost in its own noise (initial positive sequence of
// pairs of lags: Geyer, Practical Markov chain Monte Carlo, Statist. Sci. 7 (1992) 473), of at most
// 256 means of equal length, and widened for the lags that share the mean's own error. At least
// sd/√n. It covers noise whose correlation lasts a tenth of the readings or less; what is slower
// looks like a constant within one dwell, and only the scatter between runs shows it.
double mean_uncertainty(std::span<const double> deviations, double sd);

}  // namespace mdof::algo
