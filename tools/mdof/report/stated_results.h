// Stored results for charts and reports, calculated in the same way as by the other commands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/rig/reference.h"

namespace mdof::tools {

// An imported run has figures, but no uncertainty of points. Error: the run does not exist.
Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference);

// The run numbers that the arguments RUN... name, each once.
Result<std::vector<std::int64_t>> run_numbers(store::Store& store,
                                              const std::vector<std::string>& words,
                                              const std::string& axis);

// One entry for each pair of axes (XY, XZ, YZ) that has runs along both axes: the squareness,
// calculated as by `mdof squareness`, or the reason why there is none, such as several runs along
// one axis. Nothing is stored.
std::vector<charts::SquarenessOfPair> squareness_of_runs(
    store::Store& store, const std::vector<const charts::StatedResults*>& runs);

}  // namespace mdof::tools
