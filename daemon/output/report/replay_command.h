// The command with which a reader evaluates a run again from its recording, or imports it again.
#pragma once

#include <string>

#include "schema/run.h"

namespace mdof::report {

// The name of the rig file in the command; empty: the run has no rig.
std::string rig_file(const RunHeader& run);

// A shell command with the rig and the options of the run. This rig and these options override the
// rig and the options in the recording.
std::string replay_command(const Run& run);

}  // namespace mdof::report
