// Problems of the devices during a recording, for a replay of this recording.
#pragma once

#include "daemon/store/store.h"
#include "schema/run.h"

namespace mdof::daemon {

// The recording contains the samples, but not the problems of the devices. Adds the notices about
// these problems from the stored runs of the same recording. Call it before the run is stored.
Status add_known_trouble(store::Store& store, Run& run);

}  // namespace mdof::daemon
