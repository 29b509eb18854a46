// Builds a table from imported runs of the positioning of an axis. It holds only EXX (EYY, EZZ).
#pragma once

#include <optional>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/imported/series.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// distinct_targets() of the positions of the readings.
std::vector<double> imported_targets(const std::vector<ImportedReading>& readings);

// The table has the mean deviation at each target by approach, as measured, without removal of a
// line. A reading with unknown approach counts for both approaches. u is s/√n of the repeats (n - 1
// degrees of freedom); NaN if there is one reading. u_declared is the largest uncertainty declared
// at import, if each run declares one. Errors: a run that was not imported, is of another axis or
// error, or is of the same file; different targets; fewer than two targets.
//
// The table has the sense of the command. A run in the sense of the body is converted with its
// travel direction, or with `against_command` of a machine if the run does not state one. Further
// errors: both are unknown, or they differ.
Result<CompensationTable> build_positioning_table(
    const std::vector<Run>& runs, std::optional<bool> against_command = std::nullopt);
// Error: the run states another travel direction.
Status check_travel(const RunHeader& run, bool against_command);

// Notices that the user of such a table needs in addition to the notices of the runs.
Notices positioning_notices(const std::vector<Run>& runs);

}  // namespace mdof::algo
