// Uncertainty of the parameters of ISO 230-2 by ISO/TR 230-9.
#pragma once

#include "schema/iso230/positioning.h"

namespace mdof::algo {

struct PositioningConditions {
  // The device's deviations differ by this at the most, either way, between two places of the
  // travel: a rectangular distribution, standard uncertainty a/√3.
  double device_limit_m = kNoFigure;
  // E_VE: from the lowest to the highest reading of the axis at rest over as long as the test
  // takes; U(k = 2) = 0.6 E_VE. The factor 0.6 is recalled, not checked against the text of the
  // report.
  double drift_range_m = kNoFigure;
};

// What follows from a condition that is not known is NaN. Without what an average over the runs
// would gain: what drifts is alike in readings that follow one another. Temperature of the machine
// and alignment are not in it, nor is any of R, whose scatter the drift has already widened.
PositioningUncertainty positioning_uncertainty(const PositioningConditions& conditions);

}  // namespace mdof::algo
