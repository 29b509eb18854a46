// Functions for stored imported runs: notices, contributions to the standard uncertainty u, JSON
// document.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/evaluation.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/covers.h"

namespace mdof::daemon {

// The request for a table of `run` alone. The table is compared with the table of `other`. If both
// runs have the same sense and neither run states its travel, the travel "+" is assumed for both
// runs. Otherwise the travel that each run states is used.
TableRequest imported_table_request(const Run& run, const Run& other);

// Adds notices if readings have no approach, or if targets have only one reading.
Run with_positioning_notices(Run run);
// The contributions that the standard uncertainty of the readings includes.
Covers readings_coverage(const Run& run);

// The document of `mdof show` and run.get for an imported run. For other runs, run_document()
// writes it. `header`: the header of the run, complete or shortened.
std::string imported_document(const Run& run, const RunHeader& header, const StatedFigures& figures,
                              const std::string& result_sha256,
                              const std::vector<HistoryEntry>& actions, bool with_points);

}  // namespace mdof::daemon
