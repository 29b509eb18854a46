// Figures of ISO 230-2 of a run of positioning that was imported.
#pragma once

#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// By the names and definitions of ISO 230-2: E, the bi-directional systematic error (range of the
// means of both approaches), B, the reversal (the largest size of the difference of the two
// means of a target), E_forward and E_reverse. E and B need both approaches at each target, the
// others theirs at each. Of readings that do not say their approach there is only the range of the
// means of all readings, "EXX_range_um". `why`: what is left out. All are sizes, so that the sense
// of the deviations does not change them.
//
// U of a range is that of the difference of its two ends; NaN where a target has one reading, or
// only equal ones. What
// the run declares is common to the two approaches of a target, and so cancels between them.
StatedFigures positioning_figures(const Run& run);
// As if no reading said its approach: what can be compared with a run whose readings do not.
StatedFigures positioning_range(const Run& run);
bool has_unknown_approach(const Run& run);

}  // namespace mdof::daemon
