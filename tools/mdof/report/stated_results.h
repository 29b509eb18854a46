// Stored results as charts and reports take them: what the other commands state, made the same way.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/rig/reference.h"

namespace mdof::tools {

// Of an imported run: its figures, and no uncertainty of points. Error: no such run.
Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference);

// Numbers of what RUN… named, each once.
Result<std::vector<std::int64_t>> run_numbers(store::Store& store,
                                              const std::vector<std::string>& words,
                                              const std::string& axis);

// Of each pair of axes, XY, XZ, YZ, with one run along each of both among these, as
// `mdof squareness` fits it; nothing is stored.
std::vector<charts::SquarenessOfPair> squareness_of_runs(
    store::Store& store, const std::vector<const charts::StatedResults*>& runs);

}  // namespace mdof::tools
