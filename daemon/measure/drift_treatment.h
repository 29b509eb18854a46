// What a run does about drift once it is measured.
#pragma once

#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// Before its figures are made; the points are stated at the fixture. Takes a significant drift from
// the errors where that is asked for (`remove`), and says what was taken, or why nothing was, in a
// notice of the run. More drift than the rig allows is a doubtful one, also where it is removed:
// what is left of a large drift is larger.
void treat_drift(const Rig& rig, bool remove, Run& run);

}  // namespace mdof::daemon
