#pragma once

#include <vector>

namespace mdof::algo {

// The upper median if the number is even; NaN of an empty vector. No value may be NaN.
double median_of(std::vector<double> values);

}  // namespace mdof::algo
