// Builds a table from imported runs of the positioning of an axis. The table contains only the
// positioning error EXX (EYY, EZZ).
#pragma once

#include <optional>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/imported/series.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns distinct_targets() for the positions of the readings.
std::vector<double> imported_targets(const std::vector<ImportedReading>& readings);

// The table contains the mean deviation at each target for each approach, as measured; no line is
// subtracted. A reading with unknown approach counts for both approaches. u is s/√n for n repeats
// with the standard deviation s (n - 1 degrees of freedom); NaN if there is one reading. u_declared
// is the largest uncertainty declared at import; it is set only if each run declares an
// uncertainty.
//
// Errors:
// - a run that was not imported
// - runs of different axes or errors
// - two runs of the same file
// - runs with different targets
// - fewer than two targets
//
// The signs of the table refer to the direction of the command (command_sign()).
Result<CompensationTable> build_positioning_table(
    const std::vector<Run>& runs, std::optional<bool> against_command = std::nullopt);
// Returns the factor +1 or -1 that converts the deviations of an imported run to the direction of
// the command. They may refer to the direction of the moving body, and are then converted with the
// travel direction of the run. If the run does not state a travel direction, `against_command` of
// the machine is used. Errors: both the travel direction and `against_command` are unknown; the
// travel direction contradicts `against_command`.
Result<double> command_sign(const RunHeader& run,
                            std::optional<bool> against_command = std::nullopt);
// Error: the run states a travel direction that differs from `against_command`.
Status check_travel(const RunHeader& run, bool against_command);

// Returns the notices of a positioning table that are not notices of its runs.
Notices positioning_notices(const std::vector<Run>& runs);

}  // namespace mdof::algo
