// Mean and standard deviation from sums that do not depend on the order of the trials.
#pragma once

#include <array>
#include <cstdint>

#include "algo/sensitivity/kernels/kernels.h"
#include "algo/sensitivity/statistics/quantile.h"

namespace mdof::algo {

__extension__ using Int128 = __int128;

// Σ u and Σ u² of any number of cells in fixed point: integers, so that addition is associative. A
// cell's sum is rounded to 2^-48 and 2^-40, near the rounding of its own double sum. A cell's sum
// of 2^86 such steps or more (a single |u| beyond 3e11 for the mean, 8e6 for the sd) is left out
// and marks its power as lost, in whatever order the cells come.
struct PowerSums {
  std::array<Int128, 2> sum{};
  std::array<bool, 2> lost{};

  void add(const CellSums& cell);
  void add(const PowerSums& other);
  bool operator==(const PowerSums&) const = default;
};

// NaN where a power it needs was lost, or where there are too few trials.
struct Moments {
  double mean = 0, mean_se = 0, sd = 0, sd_se = 0;
};

// u = 0 is the middle of the histogram's core, u = 1 its upper end. `trials`, the same ones in
// order, gives the fourth moment, which the standard error of the sd needs: to the width of a bin.
Moments moments_of(const PowerSums& sums, const OrderedTrials& trials, const OutputScale& scale);

}  // namespace mdof::algo
