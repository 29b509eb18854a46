// The plausibility of a run as text.
#pragma once

#include <string>

#include "schema/plausibility/plausibility.h"

namespace mdof::tools {

// Lines of at most 80 columns: cycle, encoder, targets with the number of visits, rejected stops,
// probes.
std::string plausibility_text(const Plausibility& plausibility);

}  // namespace mdof::tools
