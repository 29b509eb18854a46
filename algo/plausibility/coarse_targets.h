// Checks whether the targets of a run are close enough to each other for u of its positions.
#pragma once

#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns a notice if errors may be waves that are too short for the targets. Two conditions: the
// slope that the targets do not show (LocalSlope::unseen) is at least half of the slope that they
// show, and with the declared uncertainty of the positions it contributes more to u of a point than
// the noise of the stop. With fewer than five targets the form is unknown; no notice.
Notices coarse_target_notices(const Rig& rig, const Run& run);

}  // namespace mdof::algo
