// Imported runs of an axis' positioning -> a table, which holds EXX (EYY, EZZ) alone.
#pragma once

#include <optional>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/imported/series.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// distinct_targets() of their positions.
std::vector<double> imported_targets(const std::vector<ImportedReading>& readings);

// The mean deviation at each target by approach, as measured: no line is taken from it. A reading
// whose approach was not said counts for both. u: s/√n of the repeats (n - 1); NaN where there is
// one reading. What was declared at import stands beside it, the largest of the runs', where each
// has it. Errors: a run that was not imported, of another axis or error, of the same file; other
// targets; fewer than two.
//
// The table has the sense of the command; a run in that of the body is turned by its travel, or by
// `against_command` of a machine. Errors besides: neither is known, or they differ.
Result<CompensationTable> build_positioning_table(
    const std::vector<Run>& runs, std::optional<bool> against_command = std::nullopt);
// Error: the run says another travel.
Status check_travel(const RunHeader& run, bool against_command);

// What a reader of that table should know, beside the notices of the runs.
Notices positioning_notices(const std::vector<Run>& runs);

}  // namespace mdof::algo
