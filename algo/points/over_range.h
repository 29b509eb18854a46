// Handles readings that are over the range of a probe. They are left out of the mean. If they
// belong to the same distribution as the other readings, one side of the distribution is missing,
// and the mean of the other readings is biased.
#pragma once

#include <cstddef>
#include <limits>

namespace mdof::algo {

// The over-range readings of a stop.
struct OverRange {
  std::size_t count = 0;
  // Smallest and largest over-range reading.
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  bool has_unknown = false;  // whether an over-range reading is NaN
  void add(double reading_m);
  // Returns whether the nearest over-range reading is within six standard deviations (`spread_m`)
  // of the mean of the other readings, or is NaN. This is so if a probe reaches the end of its
  // range. Readings farther away are glitches, which do not bias the mean.
  bool is_near(double mean_m, double spread_m) const;
};

// Returns whether too many of `readings` are over range for a valid mean: more than one reading,
// more than 1 % of the readings, and near to the mean (is_near()).
bool is_saturated(const OverRange& over, std::size_t readings, double mean_m, double spread_m);

// Returns u of a mean including the bias due to over-range readings near to the mean. p is the
// share of these readings. For normally distributed readings the bias is sd phi(a)/Phi(a) with
// Phi(-a) = p; phi is the density and Phi the distribution function of the normal distribution. The
// function uses 4 p sd: the bias is smaller than this for p above 1e-4, and below 0.0004 sd for a
// smaller p.
double u_with_over_range(double u_m, double mean_m, double sd_m, const OverRange& over,
                         std::size_t readings);

}  // namespace mdof::algo
