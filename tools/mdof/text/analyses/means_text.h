// The errors of a run in short: one row a target.
#pragma once

#include <cstddef>
#include <string>

#include "schema/run.h"

namespace mdof::tools {

// Means of all passes and both approaches ± u, as a table of this run alone has them (straightness
// as measured, angles relative to the first target). Empty where the run gives no table, such as
// one without targets.
std::string means_text(const Run& run, std::size_t width);

}  // namespace mdof::tools
