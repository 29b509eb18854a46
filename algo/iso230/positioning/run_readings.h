// The readings of a run as ISO 230-2 takes them: each straightness error and each angle is a series
// of deviations at targets.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/iso230/positioning.h"
#include "schema/run.h"

namespace mdof::algo {

struct RunReadings {
  std::vector<PositioningReading> readings;  // m or rad, at the point where the run is stated
  std::size_t left_out = 0;  // points that are not solved or whose approach is not known
};

// Of the error at `named` in the order of error_names(). Of a straightness error the least-squares
// line through the mean of both approaches is taken away, unless `keep_slope`: it shows how the
// target was clamped, and belongs to squareness. An angle stays as it is.
RunReadings readings_of_run(const Run& run, std::size_t named, bool keep_slope);

}  // namespace mdof::algo
