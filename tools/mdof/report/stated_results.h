// Reads stored runs for charts and reports, and calculates the same results as the other commands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/rig/reference.h"

namespace mdof::tools {

// The results of a run. For an imported run they contain figures, but no uncertainty of points.
// Error: the run does not exist.
Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference);

// The numbers of the runs that the arguments RUN... name. A repeated number is omitted.
Result<std::vector<std::int64_t>> run_numbers(store::Store& store,
                                              const std::vector<std::string>& words,
                                              const std::string& axis);

// One element for each pair of axes (XY, XZ, YZ) if `runs` contains both axes: the squareness, as
// `mdof squareness` calculates it, or the reason why it cannot be calculated, for example several
// runs of one axis. Does not store the squareness.
std::vector<charts::SquarenessOfPair> squareness_of_runs(
    store::Store& store, const std::vector<const charts::StatedResults*>& runs);

}  // namespace mdof::tools
