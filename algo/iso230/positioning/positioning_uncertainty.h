// Uncertainty of the parameters of ISO 230-2 by ISO/TR 230-9.
#pragma once

#include "schema/iso230/positioning.h"

namespace mdof::algo {

struct PositioningConditions {
  // Largest difference between the device's deviations at two positions of the travel, in either
  // direction: a rectangular distribution with standard uncertainty a/√3.
  double device_limit_m = kNoFigure;
  // E_VE: range of the readings of the axis at rest during a time as long as the test; U(k = 2) =
  // 0.6 E_VE. The factor 0.6 is quoted from memory and was not checked against the text of the
  // report.
  double drift_range_m = kNoFigure;
};

// A result is NaN if a condition that it needs is unknown. It assumes no reduction by the average
// over the runs, because drift acts alike on consecutive readings. It does not contain the
// temperature of the machine, the alignment and the uncertainty of R, whose scatter already
// contains the drift.
PositioningUncertainty positioning_uncertainty(const PositioningConditions& conditions);

}  // namespace mdof::algo
