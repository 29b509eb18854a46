#pragma once

#include <vector>

namespace mdof::algo {

// The upper median of an even number; NaN of none. None of the values may be NaN.
double median_of(std::vector<double> values);

}  // namespace mdof::algo
