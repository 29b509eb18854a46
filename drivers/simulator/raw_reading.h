// Converts the displacement of the target to the raw reading of a probe. This is the inverse of the
// calibration.
#pragma once

#include "schema/rig/rig.h"

namespace mdof::drivers {

struct RawReading {
  double um;
  bool over_range;  // true: um is limited to the end of the range
};
RawReading raw_reading(const Probe& probe, double displacement_m);
// The reading of a probe if the target is far outside the probe's range.
double end_of_range_um(const Probe& probe);

}  // namespace mdof::drivers
