// The raw readings around a stop of a stored run, from its recording or log.
#pragma once

#include <cstddef>
#include <vector>

#include "daemon/output/charts/run/raw_stop.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// The readings from half the averaged length of the stop (at least 0.2 s) before it until the same
// time after it. Errors: the run has no such point; the recording is missing or is not the source
// of the run.
Result<std::vector<charts::RawSeries>> raw_stop(const Run& run, std::size_t row);

}  // namespace mdof::tools
