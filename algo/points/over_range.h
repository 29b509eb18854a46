// Readings at the end of a probe's range. They are missing on one side of the mean, so that the
// mean of the others is biased.
#pragma once

#include <cstddef>

namespace mdof::algo {

// Whether too many are over range for the mean of the others: more than one, and more than 1 %.
bool is_saturated(std::size_t over_range, std::size_t readings);

// u of a mean of readings of which a share p is left out on one side. For normal readings the mean
// is off by sd phi(a)/Phi(a) with Phi(-a) = p. That is less than 4 p sd, or below 0.0004 sd.
double with_over_range(double u_m, double sd_m, std::size_t over_range, std::size_t readings);

}  // namespace mdof::algo
