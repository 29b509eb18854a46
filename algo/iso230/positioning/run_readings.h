// Converts the points of a run to readings for ISO 230-2. Each straightness error and each angle is
// a series of deviations at the targets.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/iso230/positioning.h"
#include "schema/run.h"

namespace mdof::algo {

struct RunReadings {
  std::vector<PositioningReading> readings;  // m or rad, at the reference point of the run
  // Number of points without errors or with an unknown approach; they have no reading.
  std::size_t left_out = 0;
};

// Returns the readings of the error with the index `named` of error_names(). For a straightness
// error the least-squares line through the mean of both approaches is subtracted, unless
// `keep_slope`. The slope of this line depends on how the target was clamped and belongs to
// squareness. Angles are not changed.
RunReadings readings_of_run(const Run& run, std::size_t named, bool keep_slope);

}  // namespace mdof::algo
