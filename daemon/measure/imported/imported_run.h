// Notices, coverage and document of a stored, imported run.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/evaluation.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/covers.h"

namespace mdof::daemon {

// The request for a table of this run alone, to compare it with `other`. If both runs have the same
// sense and neither states its travel, travel "+" is assumed for both; otherwise the statement of
// each run is used.
TableRequest imported_table_request(const Run& run, const Run& other);

// Adds notices about the readings: no approach, one reading a target.
Run with_positioning_notices(Run run);
// The contributions that u of the readings includes.
Covers readings_coverage(const Run& run);

// The document of `mdof show` and run.get for an imported run, like run_document() for other runs.
// `header`: the run's header or a shortened one.
std::string imported_document(const Run& run, const RunHeader& header, const StatedFigures& figures,
                              const std::string& result_sha256,
                              const std::vector<HistoryEntry>& actions, bool with_points);

}  // namespace mdof::daemon
