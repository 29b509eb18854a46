// Readings at the end of a probe's range. If they belong to the same distribution as the others,
// they are missing on one side, and the mean of the others is biased.
#pragma once

#include <cstddef>
#include <limits>

namespace mdof::algo {

// The over-range readings of a stop.
struct OverRange {
  std::size_t count = 0;
  // Smallest and largest of the values.
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  bool has_unknown = false;  // whether one of them is NaN
  void add(double reading_m);
  // Whether they are nearer to the mean of the others than six times their spread, as for a probe
  // that touches the end of its range. Farther ones are glitches, which do not affect the others.
  bool is_near(double mean_m, double spread_m) const;
};

// Whether too many of `readings` are over range for a valid mean: near to it, more than one, and
// more than 1 %.
bool is_saturated(const OverRange& over, std::size_t readings, double mean_m, double spread_m);

// Adds to u of a mean the bias due to readings that were left out near to it on one side, a share p
// of them. For normally distributed readings the bias is sd phi(a)/Phi(a) with Phi(-a) = p: less
// than 4 p sd, or below 0.0004 sd.
double with_over_range(double u_m, double mean_m, double sd_m, const OverRange& over,
                       std::size_t readings);

}  // namespace mdof::algo
