// The analysis of a stored run: straightness by each reference line, angles, figures with their
// uncertainty, and drift. Made on reading.
#pragma once

#include <string>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::daemon {

// Document of `mdof show --figures --json` and run.analyse, for the run as it is stated. Error
// (bad_input): an imported run.
Result<std::string> analysis_document(store::Store& store, const Run& run);

}  // namespace mdof::daemon
