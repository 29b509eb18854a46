// Figures of ISO 230-2 for an imported run of positioning.
#pragma once

#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// Names and definitions are those of ISO 230-2:
//   E: bi-directional systematic error, the range of the means of both approaches;
//   B: reversal, the largest absolute difference between the two means of a target;
//   E_forward, E_reverse: range of the means of one approach.
// E and B need both approaches at each target. E_forward needs the forward approach at each target,
// and E_reverse the reverse approach. If readings do not state their approach, the only figure is
// "EXX_range_um", the range of the means of all readings. The member `why` names the missing
// figures. No figure depends on the sense of the deviations, because no figure has a sign.
//
// u is the uncertainty of the difference between the largest and the smallest mean; U is that of a
// range (algo/uncertainty/statistics/range_interval.h), from trials of all means. Both are NaN if
// one of these two means is from a single reading or from equal readings only. An uncertainty that
// the run declares is the same for both approaches of a target. This uncertainty cancels in the
// difference between the two means of a target.
StatedFigures positioning_figures(const Run& run);
// Calculates "EXX_range_um" also if the readings state their approach. This figure can be compared
// with the figure of a run whose readings do not state the approach.
StatedFigures positioning_range(const Run& run);
bool has_unknown_approach(const Run& run);

}  // namespace mdof::daemon
