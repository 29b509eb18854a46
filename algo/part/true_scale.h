// The lower end of the coverage interval of a figure of the error along a path: p95, or the largest
// error (README.md, "Lower end"). The lower end is the smallest true figure that a test does not
// reject. The test assumes that the true errors are s * value with a factor s >= 0; `value` is the
// measured error along the path.
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

// Returns one factor s for each trial, in ascending order; their distribution function is P(s) of
// README.md. `ranges`: possible_scales() of each trial. With an s outside its range, the figure of
// a trial exceeds the measured figure.
std::vector<double> drawn_scales(const std::vector<ScaleRange>& ranges);

// Returns the k-th factor s for the lower end. If the true figure is at most always_m, the upper
// end is never below it, so that the lower end may have all 5 %: P(s) = 5 % then counts as 2.5 %.
// `scales`: result of drawn_scales(). value_m: figure of `value`.
double lower_scale(const std::vector<double>& scales, std::size_t k, double value_m,
                   double always_m);

}  // namespace mdof::algo
