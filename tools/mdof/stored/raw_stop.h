// The raw readings around a stop of a stored run, from its recording or log.
#pragma once

#include <cstddef>
#include <vector>

#include "daemon/output/charts/run/raw_stop.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// From half the stop's averaged length (0.2 s at least) before it to as long after it. Errors: the
// run has no such point; its recording is not there, or not what the run was made from.
Result<std::vector<charts::RawSeries>> raw_stop(const Run& run, std::size_t row);

}  // namespace mdof::tools
