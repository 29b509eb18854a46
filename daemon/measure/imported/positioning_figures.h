// Figures of ISO 230-2 for an imported run of positioning.
#pragma once

#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// Names and definitions are those of ISO 230-2: E, the bi-directional systematic error (range of
// the means of both approaches); B, the reversal (the largest absolute difference of the two means
// of a target); E_forward and E_reverse. E and B need both approaches at each target; E_forward and
// E_reverse need their approach at each target. If the readings do not state their approach, the
// only figure is the range of the means of all readings, "EXX_range_um". `why` names the figures
// that are left out. All figures are absolute values, so that the sense of the deviations does not
// change them.
//
// U of a range is U of the difference of its two ends. It is NaN if a target has one reading or
// only equal readings. An uncertainty that the run declares is common to both approaches of a
// target and so cancels in their difference.
StatedFigures positioning_figures(const Run& run);
// The range as if no reading stated its approach. It can be compared with a run whose readings do
// not state it.
StatedFigures positioning_range(const Run& run);
bool has_unknown_approach(const Run& run);

}  // namespace mdof::daemon
