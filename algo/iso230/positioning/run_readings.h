// The readings of a run in the form of ISO 230-2: each straightness error and each angle is a
// series of deviations at targets.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/iso230/positioning.h"
#include "schema/run.h"

namespace mdof::algo {

struct RunReadings {
  std::vector<PositioningReading> readings;  // m or rad, at the point where the run is stated
  // Points that are not solved or whose approach is unknown.
  std::size_t left_out = 0;
};

// Readings of error `named` in the order of error_names(). For a straightness error the
// least-squares line through the mean of both approaches is subtracted unless `keep_slope`, because
// the line shows how the target was clamped and belongs to squareness. Angles stay unchanged.
RunReadings readings_of_run(const Run& run, std::size_t named, bool keep_slope);

}  // namespace mdof::algo
