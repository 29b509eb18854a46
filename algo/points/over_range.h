// Readings at the end of a probe's range. Where they belong to the others, they are missing on one
// side of the mean, so that the mean of the others is biased.
#pragma once

#include <cstddef>
#include <limits>

namespace mdof::algo {

// Those of a stop.
struct OverRange {
  std::size_t count = 0;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;  // of their values
  bool has_unknown = false;                                                 // one that is NaN
  void add(double reading_m);
  // Nearer to the mean of the others than six times their spread, as of a probe that touches the
  // end of its range. Further off they are glitches, which say nothing of the others.
  bool is_near(double mean_m, double spread_m) const;
};

// Whether too many of `readings` are over range for the mean of the others: near to it, more than
// one, and more than 1 %.
bool is_saturated(const OverRange& over, std::size_t readings, double mean_m, double spread_m);

// Adds to u of a mean the bias by readings that were left out near to it, on one side: a share p of
// them. For normal readings the bias is sd phi(a)/Phi(a) with Phi(-a) = p: less than 4 p sd, or
// below 0.0004 sd.
double with_over_range(double u_m, double mean_m, double sd_m, const OverRange& over,
                       std::size_t readings);

}  // namespace mdof::algo
