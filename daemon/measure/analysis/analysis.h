// The analysis of a stored run: straightness by each reference line, angles, figures with their
// uncertainty, and drift. It is calculated on request and not stored.
#pragma once

#include <string>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::daemon {

// The document of `mdof show --figures --json` and run.analyse, for the run at its stated point.
// Error (bad_input): an imported run.
Result<std::string> analysis_document(store::Store& store, const Run& run);

}  // namespace mdof::daemon
