#include "algo/iso230/positioning/positioning_uncertainty.h"

#include <cmath>

namespace mdof::algo {

PositioningUncertainty positioning_uncertainty(const PositioningConditions& conditions) {
  constexpr double kCoverage = 2;
  constexpr double kDriftFactor = 0.6;
  PositioningUncertainty U;
  U.device = kCoverage * conditions.device_limit_m / std::sqrt(3.0);
  U.drift = kDriftFactor * conditions.drift_range_m;
  U.E_M_A = std::sqrt(U.device * U.device + U.drift * U.drift);
  U.B = U.drift;
  return U;
}

}  // namespace mdof::algo
