// A control chart of single values (Shewhart; NIST/SEMATECH handbook 6.3.2): shows whether a value
// that is measured repeatedly has changed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mdof::algo {

struct ChartValue {
  double value = 0, u = 0;  // u: its own standard uncertainty; 0: unknown
};

struct Chart {
  std::size_t baseline = 0;          // number of first values that determine centre and sigma
  double centre = 0, sigma = 0;      // mean of the baseline; mean moving range / 1.128
  std::vector<double> low, high;     // limits of each value: centre ± 3 max(sigma, its own u)
  std::vector<std::size_t> outside;  // indices beyond these limits
  // Indices of the eighth, ninth ... consecutive value on one side of the centre.
  std::vector<std::size_t> one_side;

  // Set if the last value is in one of the two lists above: the index from which the values differ
  // from those before, and by how much. The index is the least-squares division into two means.
  struct Moved {
    std::size_t since = 0;
    double by = 0, u = 0;  // difference of the two means; u from sigma, or from the values' own u
  };
  std::optional<Moved> moved;
};

inline constexpr std::size_t kLeastBaselineValues = 4, kOneSideRunLength = 8;

// `baseline`: number of first values; 0: all but the last. Empty: fewer than kLeastBaselineValues
// values, so that no statement is possible.
std::optional<Chart> control_chart(const std::vector<ChartValue>& values, std::size_t baseline = 0);

}  // namespace mdof::algo
