#include "schema/uncertainty/chi_square_limit.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mdof {
namespace {

// Quantiles of χ² at the probability 1 - 1e-6, for 1, 2 ... degrees of freedom.
constexpr std::array<double, 11> kLimits = {23.928, 27.631, 30.665, 33.377, 35.888, 38.258,
                                            40.522, 42.701, 44.811, 46.863, 48.866};

}  // namespace

double chi_square_limit(int freedom) {
  const auto k = static_cast<std::size_t>(std::max(freedom, 1)) - 1;
  // Linear extrapolation after the end of the table; it is larger than the true value.
  return k < kLimits.size() ? kLimits[k] : kLimits.back() + 2.1 * static_cast<double>(k - 10);
}

}  // namespace mdof
