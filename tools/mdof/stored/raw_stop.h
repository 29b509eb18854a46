// Reads the raw readings around a stop of a stored run from the recording or log of the run.
#pragma once

#include <cstddef>
#include <vector>

#include "daemon/output/charts/run/raw_stop.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// Returns the readings during the averaged time of the stop, and before and after it. The time
// before and the time after are each half the averaged time, but at least 0.2 s. `row`: index of
// the point in the run. Errors: the run has no such point; the recording is missing, or is not the
// source of the run.
Result<std::vector<charts::RawSeries>> raw_stop(const Run& run, std::size_t row);

}  // namespace mdof::tools
