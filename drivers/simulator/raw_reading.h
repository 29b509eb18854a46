// Converts the displacement of the target to the raw reading of a probe: the inverse of its
// calibration.
#pragma once

#include "schema/rig/rig.h"

namespace mdof::drivers {

struct RawReading {
  double um;
  bool over_range;  // limited to the end of the range
};
RawReading raw_reading(const Probe& probe, double displacement_m);
// The reading of a probe whose target is far outside its range.
double end_of_range_um(const Probe& probe);

}  // namespace mdof::drivers
