// The reading of a probe at a target that the axis passes without stopping.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mdof::algo {

struct BinFit {
  double value = 0, slope = 0;  // reading and its slope at the target; slope per half bin
  double sd = 0;                // standard deviation of single readings about the parabola
  double u = 0;                 // standard uncertainty of the value, see below
  std::size_t used = 0, rejected = 0;
};

inline constexpr std::size_t kLeastReadingsPerBin = 8;

// Fits the least-squares parabola to the readings of a bin. `place`: distance of each reading from
// the target in half bins (-1 ... 1), in the order of time. A parabola is necessary: the error of a
// plain mean would be the slope times the mean distance of the readings from the target. With a
// line instead of the parabola, the error would be a third of the distance between the parabola and
// its tangent at the target, measured at an end of the bin. If the reading is a wave of amplitude a
// and length L, and the bin has the length w, the error of the parabola at the target is a (pi
// w/L)^4/280: 1 % of a if L is 2.5 w.
//
// Spikes are left out before the fit. The limit is 8 robust standard deviations, but at least
// `coarse`.
// - First, a reading is left out if its distance from the median of its five neighbours along the
//   travel is above the limit.
// - If spikes were found, the limit is also applied to the distances from a line through the
//   medians of the two halves, and then to the distances from the parabola.
// - If no spikes were found, a reading is left out if its distance from the line is above twelve
//   times the limit. If the first or the last reading is so far from the line, no reading is left
//   out.
//
// u is mean_uncertainty() for correlated readings, times the ratio of the u of a parabola to the u
// of a mean (1.5 if the readings are evenly spread over the bin). u contains the effect of changes
// within the bin, but not of a vibration with fewer than two periods in the bin, which cannot be
// distinguished from a change of the reading with the position. If `used` is below
// kLeastReadingsPerBin, no parabola is fitted.
BinFit fit_bin(std::span<const double> place, std::span<const double> reading, double coarse,
               std::vector<double>& scratch);

}  // namespace mdof::algo
