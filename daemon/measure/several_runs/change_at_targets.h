// The change of the errors at the targets from one run to another. This change can be large
// although a figure of these errors, such as a range, has not changed.
#pragma once

#include "daemon/measure/several_runs/compared_points.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// The change in m or rad, for a figure of this kind:
//   ranges: the largest minus the smallest change of the error at the targets;
//   straightness: the same, after the least-squares line of the changes is subtracted;
//   B: the largest change of the reversal;
//   slopes: the absolute value of the change of the slope.
// If the second run has the same error with the opposite sign, the change is twice the range. NaN:
// no target has a value in both runs.
double change_at_targets(const Budget& before, const Budget& after, const ComparedPoints& compared);

}  // namespace mdof::daemon
