// Slopes of the errors of a run along its axis.
#pragma once

#include <vector>

#include "schema/run.h"

namespace mdof::algo {

// Slope of the errors at each point, per 1 m of the target's travel. Local frame, at the reference
// point of the run. The slope is calculated between the means of the two neighbouring
// targets, with the approach of the point. If the targets of this approach are all at one place,
// the means of both approaches are used. If all targets are at one place, the slope is 0. Targets
// at a smaller distance than 2 % of the mean step are taken as one place, because the difference
// between them is mainly noise.
std::vector<Errors5> local_slopes(const Run& run);

}  // namespace mdof::algo
