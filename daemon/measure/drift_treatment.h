// Treats the drift of a measured run.
#pragma once

#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// Call it before the figures are calculated, with the points stated at the fixture. Removes a
// significant drift from the errors if `remove` is set; a notice states the removed drift, or why
// nothing was removed. Drift beyond the limit of the rig makes the run doubtful even if it is
// removed, because the remainder of a large drift is larger.
void treat_drift(const Rig& rig, bool remove, Run& run);

}  // namespace mdof::daemon
