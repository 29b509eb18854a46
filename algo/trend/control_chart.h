// A control chart of single values (Shewhart; NIST/SEMATECH handbook 6.3.2): has a figure that is
// measured again and again moved?
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mdof::algo {

struct ChartValue {
  double value = 0, u = 0;  // u: its own standard uncertainty; 0: not known
};

struct Chart {
  std::size_t baseline = 0;          // values that centre and sigma are made of: the first ones
  double centre = 0, sigma = 0;      // their mean; mean moving range / 1.128
  std::vector<double> low, high;     // of each value: centre ± 3 max(sigma, its own u)
  std::vector<std::size_t> outside;  // beyond these limits
  std::vector<std::size_t>
      one_side;  // the eighth, ninth ... value in a row on one side of the centre

  // The last value is one of the two above: since which value, and by how much, the later ones lie
  // away from those before. The place where it moved is that of the least squares of two means.
  struct Moved {
    std::size_t since = 0;
    double by = 0, u = 0;  // difference of the two means; u by sigma, or by the values' own u
  };
  std::optional<Moved> moved;
};

inline constexpr std::size_t kFewestOfBaseline = 4, kRunOfOneSide = 8;

// `baseline`: so many first values; 0: all but the last. None: there are fewer than
// kFewestOfBaseline for it, so that nothing can be said.
std::optional<Chart> control_chart(const std::vector<ChartValue>& values, std::size_t baseline = 0);

}  // namespace mdof::algo
