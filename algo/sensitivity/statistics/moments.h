// Mean and standard deviation of trials, from sums that do not depend on the order of the trials.
#pragma once

#include <array>
#include <cstdint>

#include "algo/sensitivity/kernels/kernels.h"
#include "algo/sensitivity/statistics/quantile.h"

namespace mdof::algo {

__extension__ using Int128 = __int128;

// Σ u and Σ u² of any number of cells, as fixed-point integers. The sums of integers do not depend
// on the order of the cells. Σ u of a cell is rounded to a multiple of 2^-48, and Σ u² to a
// multiple of 2^-40; this is about the rounding error of a double. A multiple of 2^86 or more is
// not added, and `lost` is set for this power of u. This occurs if one |u| is above 3e11 (Σ u) or
// above 8e6 (Σ u²).
struct PowerSums {
  std::array<Int128, 2> sum{};
  std::array<bool, 2> lost{};

  void add(const CellSums& cell);
  void add(const PowerSums& other);
  bool operator==(const PowerSums&) const = default;
};

// With standard errors (se). A value is NaN if a necessary power was lost, or if there are too few
// trials.
struct Moments {
  double mean = 0, mean_se = 0, sd = 0, sd_se = 0;
};

// u = 0 is the middle of the core of the histogram, u = 1 is its upper end. `trials`: the same
// trials in ascending order. The fourth moment, for the standard error of the sd, is calculated
// from them; its accuracy is limited by the width of the bins.
Moments moments_of(const PowerSums& sums, const OrderedTrials& trials, const OutputScale& scale);

}  // namespace mdof::algo
