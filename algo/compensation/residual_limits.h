// What a correction may leave of an error: of the self-test of exports, and of what a table says of
// itself.
#pragma once

#include <algorithm>

namespace mdof::algo {

// Unless more is asked for: no more than `most_m`, of angles in rad, and no more than `share` of
// the error; a step of the numbers is always.
struct ResidualLimits {
  double most_m = 1e-6, share = 0.2;

  double of(double error, double step) const {
    return std::min(most_m, std::max(share * error, step));
  }
};

}  // namespace mdof::algo
