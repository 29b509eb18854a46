// A sum whose additions have the same order on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace mdof::algo {

// Returns the sum of term(&x[i]) over all elements of x. It is calculated as eight parallel sums,
// which is faster: in a single sum each addition waits for the addition before.
template <class Term>
double lane_sum(std::span<const double> x, Term term) {
  constexpr std::size_t kSums = 8;
  std::array<double, kSums> sums{};
  std::size_t i = 0;
  for (; i + kSums <= x.size(); i += kSums)
    for (std::size_t k = 0; k < kSums; ++k) sums[k] += term(&x[i + k]);
  for (std::size_t k = 0; i < x.size(); ++i, ++k) sums[k] += term(&x[i]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace mdof::algo
