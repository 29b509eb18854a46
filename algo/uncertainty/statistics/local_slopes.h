// Slopes of the errors of a run along its axis.
#pragma once

#include <vector>

#include "schema/run.h"

namespace mdof::algo {

// Change of the errors of each point by 1 m of the target's travel: local frame, stated at the same
// place as the errors of the run. The slope is that between the means of the neighbouring targets
// of the point's approach. If this approach has targets at one place only, the means of both
// approaches are used; if they have one place only, the slope is 0. Targets nearer than 2 % of the
// mean step are one place, because noise between them is no slope.
std::vector<Errors5> local_slopes(const Run& run);

}  // namespace mdof::algo
