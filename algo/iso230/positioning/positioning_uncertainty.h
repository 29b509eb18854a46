// Uncertainty of the parameters of ISO 230-2 by ISO/TR 230-9.
#pragma once

#include "schema/iso230/positioning.h"

namespace mdof::algo {

struct PositioningConditions {
  // a: largest absolute difference between the errors of the measuring device at two positions of
  // the travel. The distribution is rectangular with the standard uncertainty a/√3.
  double device_limit_m = kNoFigure;
  // E_VE: range of the readings while the axis is at rest for the duration of the test; U(k = 2) =
  // 0.6 E_VE. A rectangular distribution with this range has U(k = 2) = E_VE/√3 = 0.58 E_VE.
  double drift_range_m = kNoFigure;
};

// A result is NaN if a condition from which it is calculated is unknown. The average over the runs
// does not reduce the uncertainty, because consecutive readings have nearly the same drift. The
// results do not contain the contributions of the machine's temperature and of the alignment. The
// uncertainty of R is not calculated, because the scatter of the readings already contains the
// drift.
PositioningUncertainty positioning_uncertainty(const PositioningConditions& conditions);

}  // namespace mdof::algo
