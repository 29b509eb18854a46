// Mean and standard deviation from sums that do not depend on the order of the trials.
#pragma once

#include <array>
#include <cstdint>

#include "algo/sensitivity/kernels/kernels.h"
#include "algo/sensitivity/statistics/quantile.h"

namespace mdof::algo {

__extension__ using Int128 = __int128;

// Σ u and Σ u² of any number of cells as fixed-point integers, so that addition is associative. The
// sum of a cell is rounded to 2^-48 and 2^-40, which is near the rounding of its double sum. If a
// cell's sum has 2^86 such steps or more (one |u| above 3e11 for the mean, above 8e6 for the sd),
// it is omitted and its power is marked as lost, whatever the order of the cells.
struct PowerSums {
  std::array<Int128, 2> sum{};
  std::array<bool, 2> lost{};

  void add(const CellSums& cell);
  void add(const PowerSums& other);
  bool operator==(const PowerSums&) const = default;
};

// NaN if a required power was lost, or if there are too few trials.
struct Moments {
  double mean = 0, mean_se = 0, sd = 0, sd_se = 0;
};

// u = 0 is the middle of the histogram's core, u = 1 its upper end. `trials`: the same trials in
// ascending order. They give the fourth moment for the standard error of the sd, to the width of a
// bin.
Moments moments_of(const PowerSums& sums, const OrderedTrials& trials, const OutputScale& scale);

}  // namespace mdof::algo
