// Removes the drift of a measured run, and compares the drift with its limit.
#pragma once

#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// Call this function before the figures are calculated. The reference point of the errors must be
// the fixture. If `remove` is true, a significant drift is removed from the errors. A notice states
// the removed drift, or the reason why no drift was removed. Another notice states significant
// changes that remain in the reversal values; it makes a table from the run doubtful. If the drift
// exceeds the limit of the rig, the run is doubtful, even if the drift is removed: after the
// removal of a large drift, a large remainder is possible.
void treat_drift(const Rig& rig, bool remove, Run& run);

}  // namespace mdof::daemon
