// Limits of the residual errors after a correction, for the self-test of exports and for the
// notices of a table.
#pragma once

#include <algorithm>

namespace mdof::algo {

// Largest allowed residual with the default limits: the larger value of `share` times the error and
// one step of the exported numbers, but at most `most_m` (rad for angles).
struct ResidualLimits {
  double most_m = 1e-6, share = 0.2;

  double of(double error, double step) const {
    return std::min(most_m, std::max(share * error, step));
  }
};

}  // namespace mdof::algo
