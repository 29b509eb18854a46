// A control chart of single values (Shewhart; NIST/SEMATECH handbook 6.3.2). It shows whether a
// repeatedly measured value has changed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mdof::algo {

struct ChartValue {
  double value = 0, u = 0;  // u: standard uncertainty of the value; 0: unknown
};

struct Chart {
  std::size_t baseline = 0;  // number of first values that determine centre and sigma
  // Centre: mean of the baseline; sigma: mean moving range / 1.128.
  double centre = 0, sigma = 0;
  std::vector<double> low, high;     // limits of each value: centre ± 3 max(sigma, u of the value)
  std::vector<std::size_t> outside;  // indices of the values beyond these limits
  // Indices of values with at least seven values before them on the same side of the centre without
  // interruption.
  std::vector<std::size_t> one_side;

  // Set if the last value is in one of the two lists above. `since`: first index of the second
  // group, if the values are divided into two groups so that the sum of the squared differences
  // from the group means is smallest.
  struct Moved {
    std::size_t since = 0;
    // Difference of the two group means, and its u: the larger of the u from sigma and the u from
    // the u of the values.
    double by = 0, u = 0;
  };
  std::optional<Moved> moved;
};

inline constexpr std::size_t kLeastBaselineValues = 4, kOneSideRunLength = 8;

// `baseline`: number of first values that determine centre and sigma; 0: all values except the
// last. Returns nothing if there are too few values (kLeastBaselineValues).
std::optional<Chart> control_chart(const std::vector<ChartValue>& values, std::size_t baseline = 0);

}  // namespace mdof::algo
