// Short table of the errors of a run, with one row for each target.
#pragma once

#include <cstddef>
#include <string>

#include "schema/run.h"

namespace mdof::tools {

// Means of all passes and both approaches ± u, as in a compensation table of this run alone
// (straightness as measured, angles relative to the first target). Empty if the run gives no table,
// for example because it has no targets.
std::string means_text(const Run& run, std::size_t width);

}  // namespace mdof::tools
