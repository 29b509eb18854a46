// A run's plausibility as a block for people.
#pragma once

#include <string>

#include "schema/plausibility/plausibility.h"

namespace mdof::tools {

// Lines of 80 columns at the most: cycle, encoder, targets with the visits of each, stops left out,
// probes.
std::string plausibility_text(const Plausibility& plausibility);

}  // namespace mdof::tools
