// The drift of a stored run as text for people.
#pragma once

#include <string>

#include "algo/drift/run_drift.h"
#include "daemon/measure/analysis/stored_drift.h"
#include "schema/run.h"

namespace mdof::tools {

using daemon::drift_of;
using daemon::DriftOfStored;

// Sentences on a significant drift, lines; "": none.
std::string drift_notice(const Run& run, const algo::RunDrift& drift, std::size_t width);
// What `mdof show --figures` prints of it: closures, each error's drift, what it does to straightness.
std::string drift_text(const Run& run, const DriftOfStored& drift, std::size_t width);

}  // namespace mdof::tools
