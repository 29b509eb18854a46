// How a run is evaluated again from its recording, or imported again.
#pragma once

#include <string>

#include "schema/run.h"

namespace mdof::report {

// The file in which the command looks for the rig of a run; empty: the run has none.
std::string rig_file(const RunHeader& run);

// For a shell, with the rig and the options that were used, whatever the recording has.
std::string replay_command(const Run& run);

}  // namespace mdof::report
