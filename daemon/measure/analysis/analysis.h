// The analysis of a stored run: the straightness for each reference line, the angles, the figures
// with their uncertainty, and the drift. The analysis is calculated on request and not stored.
#pragma once

#include <string>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::daemon {

// The document of `mdof show --figures --json` and run.analyse. run.header.stated is the reference
// point of the errors. Error (bad_input): the run is imported.
Result<std::string> analysis_document(store::Store& store, const Run& run);

}  // namespace mdof::daemon
