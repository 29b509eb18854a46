// What a probe reads at a target that the axis passes without stopping.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mdof::algo {

struct BinFit {
  double value = 0, slope = 0;  // at the target; the slope is per half bin
  double sd = 0;                // of what the parabola leaves of single readings
  double u = 0;                 // standard uncertainty of the value by that, see below
  std::size_t used = 0, rejected = 0;
};

inline constexpr std::size_t kFewestOfBin = 8;  // readings

// The least-squares parabola through the readings of a bin, over `place`, their distances from the
// target in half bins (-1 ... 1), in the order of time. A plain mean would be off by the slope
// times the mean distance, a line by a twelfth of the bend across half a bin. Of a wave of
// amplitude a and length L in a bin of length w the parabola leaves a (pi w/L)^4/280 at the target:
// 1 % where L is 2.5 w.
//
// Spikes are left out first: readings further than 8 robust standard deviations, and than `coarse`,
// from the median of their five neighbours along the way. Where there are any, also those as far
// from a line through the medians of the halves, and then from the parabola; where there are none,
// those inside the bin that are twelve times farther from that line. u: as mean_uncertainty(), for
// readings that are not independent, times what the parabola has more than a mean (1.5 where the
// readings are even over the bin). It covers what changes within the bin; a vibration of fewer than
// two periods in it looks like form. `used` below kFewestOfBin: nothing is fitted.
BinFit fit_bin(std::span<const double> place, std::span<const double> reading, double coarse,
               std::vector<double>& scratch);

}  // namespace mdof::algo
