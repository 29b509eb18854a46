// A short table of the errors of a run.
#pragma once

#include <cstddef>
#include <string>

#include "schema/run.h"

namespace mdof::tools {

// One row for each target: the mean over all visits and both approaches ± u, as in a compensation
// table from this run only. The slope of straightness errors is not removed; angles are relative to
// the first target. Empty if no compensation table can be calculated, for example because the run
// has no targets.
std::string means_text(const Run& run, std::size_t width);

}  // namespace mdof::tools
