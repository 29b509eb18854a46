// The document of a replayed run, for the command line and the RPC.
#pragma once

#include <string>

#include "daemon/measure/budgets.h"
#include "schema/run.h"

namespace mdof::daemon {

// With the points, as `mdof replay --json` prints it.
std::string replay_document(const Run& run, const StatedRun& stated);
// Without the points, so that it fits into a reply. If it is still too long, the note, the notices
// and the options are shortened.
std::string replay_reply(const Run& run, const StatedRun& stated);

}  // namespace mdof::daemon
