#pragma once

#include <vector>

namespace mdof::algo {

// Returns the median, the upper one if the number of values is even; NaN if there are no values. No
// value may be NaN.
double median_of(std::vector<double> values);

}  // namespace mdof::algo
