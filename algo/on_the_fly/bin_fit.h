// The reading of a probe at a target that the axis passes without stopping.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mdof::algo {

struct BinFit {
  double value = 0, slope = 0;  // at the target; the slope is per half bin
  double sd = 0;                // standard deviation of single readings about the parabola
  double u = 0;                 // standard uncertainty of the value, see below
  std::size_t used = 0, rejected = 0;
};

inline constexpr std::size_t kLeastReadingsPerBin = 8;  // readings

// Fits the least-squares parabola to the readings of a bin over `place`, their distances from the
// target in half bins (-1 ... 1), in the order of time. The error of a plain mean would be the
// slope times the mean distance; that of a line would be a twelfth of the bend across half a bin.
// For a wave of amplitude a and length L in a bin of length w, the error of the parabola at the
// target is a (pi w/L)^4/280: 1 % if L is 2.5 w.
//
// First, spikes are left out: readings whose distance from the median of their five neighbours
// along the travel is above 8 robust standard deviations and above `coarse`. If there are any, the
// same limit is then applied to the distances from a line through the medians of the two halves,
// and then from the parabola. If there are none, readings inside the bin with twelve times this
// distance from the line are left out. u is as mean_uncertainty() for correlated readings, times
// the ratio of the u of a parabola to that of a mean (1.5 if the readings are evenly spread over
// the bin). It covers changes within the bin, but a vibration with fewer than two periods in the
// bin looks like form. If `used` is below kLeastReadingsPerBin, nothing is fitted.
BinFit fit_bin(std::span<const double> place, std::span<const double> reading, double coarse,
               std::vector<double>& scratch);

}  // namespace mdof::algo
