// JSON documents of a replayed run, for the command line and the RPC method.
#pragma once

#include <string>

#include "daemon/measure/budgets.h"
#include "schema/run.h"

namespace mdof::daemon {

// The document of `mdof replay --json`. It contains the points.
std::string replay_document(const Run& run, const StatedRun& stated);
// The document of the RPC method. It does not contain the points, because a reply is too short for
// them. If the document is still too long, the note, the notices and the options are shortened.
std::string replay_reply(const Run& run, const StatedRun& stated);

}  // namespace mdof::daemon
