// A replayed run as the command line and the RPC give it.
#pragma once

#include <string>

#include "daemon/measure/budgets.h"
#include "schema/run.h"

namespace mdof::daemon {

// With its points, as `mdof replay --json` prints it.
std::string replay_document(const Run& run, const StatedRun& stated);
// The same without the points, as it fits into a reply; of a run that is longer all the same the
// note, the notices and the options are cut.
std::string replay_reply(const Run& run, const StatedRun& stated);

}  // namespace mdof::daemon
