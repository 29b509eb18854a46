// The change of a figure's errors at the targets. It can be large although the size of the figure
// is the same.
#pragma once

#include "daemon/measure/several_runs/compared_points.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// In m or rad. Straightness and ranges: the highest minus the lowest change of the error at the
// targets (for straightness about the least-squares line of the changes), so that an inverted shape
// gives twice its size. B: the largest change of the reversal. Slopes: the absolute change of the
// signed slope. NaN: no target has a value in both runs.
double change_at_targets(const Budget& before, const Budget& after, const ComparedPoints& compared);

}  // namespace mdof::daemon
