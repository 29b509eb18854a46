// The plausibility of a run as text.
#pragma once

#include <string>

#include "schema/plausibility/plausibility.h"

namespace mdof::tools {

// Describes the cycle, the encoder, the targets with their numbers of visits, the rejected stops,
// and the probes. A line has at most 80 characters.
std::string plausibility_text(const Plausibility& plausibility);

}  // namespace mdof::tools
