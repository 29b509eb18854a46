// What is stated of a stored run that was imported.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/evaluation.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/covers.h"

namespace mdof::daemon {

// For the table of this run alone, to compare it with the other: its deviations as they stand where
// both state one sense and neither is against the command, otherwise as each run states its sense.
TableRequest table_of_imported(const Run& run, const Run& other);

// With what its readings alone show: no approach, one reading a target.
Run with_positioning_notices(Run run);
// What u of its readings covers.
Covers covers_of_readings(const Run& run);

// What `mdof show` and run.get give of it, as run_document() of other runs; `header`: the run's, or
// a shorter one.
std::string imported_document(const Run& run, const RunHeader& header, const StatedFigures& figures,
                              const std::string& result_sha256,
                              const std::vector<HistoryEntry>& actions, bool with_points);

}  // namespace mdof::daemon
