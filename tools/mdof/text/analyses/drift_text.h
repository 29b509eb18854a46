// The drift of a stored run as text.
#pragma once

#include <string>

#include "algo/drift/run_drift.h"
#include "daemon/measure/analysis/stored_drift.h"
#include "schema/run.h"

namespace mdof::tools {

using daemon::drift_of;
using daemon::StoredDrift;

// Sentences about a significant drift, one line each; empty: no significant drift.
std::string drift_notice(const Run& run, const algo::RunDrift& drift, std::size_t width);
// The drift as `mdof show --figures` prints it: closures, drift of each error, effect of the drift
// on the straightness.
std::string drift_text(const Run& run, const StoredDrift& drift, std::size_t width);

}  // namespace mdof::tools
