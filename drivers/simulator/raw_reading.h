// From the displacement of the target to the raw number of a probe: its calibration backwards.
#pragma once

#include "schema/rig/rig.h"

namespace mdof::drivers {

struct RawReading {
  double um;
  bool over_range;  // held at the end of the range
};
RawReading raw_reading(const Probe& probe, double displacement_m);
// The reading of a probe whose target is far out of reach.
double end_of_range_um(const Probe& probe);

}  // namespace mdof::drivers
