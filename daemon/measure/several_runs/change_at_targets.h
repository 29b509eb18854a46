// By how much a figure's errors changed at the targets, where its size need not have.
#pragma once

#include "daemon/measure/several_runs/compared_points.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// m or rad. Of a straightness and a range: the highest minus the lowest change of the error at the
// targets (of straightness about its own least-squares line), so that a shape that turned round
// has twice its size; of B the largest change of the reversal; of a slope its own change, with its
// sign taken. NaN: no target has a value in both runs.
double change_at_targets(const Budget& before, const Budget& after, const ComparedPoints& compared);

}  // namespace mdof::daemon
