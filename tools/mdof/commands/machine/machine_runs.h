// Stored runs as the measured errors of a machine.
#pragma once

#include <string>
#include <vector>

#include "schema/machine/machine.h"

namespace mdof::tools {

// Runs of the same axis give their mean. Straightness is about its least-squares line, as its slope
// belongs to a squareness; it is taken to hold at holds_at_mm of the axis. Errors: a run of an axis
// that the chain has not, or of an error that MACHINE.toml has too; those of a table of runs.
Status add_runs(Machine& machine, const std::string& database,
                const std::vector<std::string>& runs);

}  // namespace mdof::tools
