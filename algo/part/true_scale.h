// The lower end of the interval of p95 and of the largest error: a test of true errors s * value
// with a factor s >= 0, where `value` is the measured error along the path (README.md).
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

struct ScaleRange {
  double low = 0, high = 0;
};

// The range of the factors s >= 0 for which `within` points have |s value + error| <= most_m. A
// point has `width` numbers. If there is no such s, both ends are the s for which the sum of
// |s value + error|^2 is smallest.
ScaleRange possible_scales(const std::vector<double>& value, const std::vector<double>& error,
                           std::size_t width, std::size_t within, double most_m);

// Factors s with the distribution function P(s) of README.md: a sorted list with one s for each
// trial. `ranges`: of the trials. A trial exceeds the measured figure outside its range.
std::vector<double> drawn_scales(const std::vector<ScaleRange>& ranges);

// The k-th factor s for the lower end. Up to always_m, where the upper end is never below the
// truth, P(s) = 5 % counts as 2.5 %. `scales`: by drawn_scales(). value_m: figure of the value.
double lower_scale(const std::vector<double>& scales, std::size_t k, double value_m,
                   double always_m);

}  // namespace mdof::algo
