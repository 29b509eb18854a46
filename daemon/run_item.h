// A run's header as one item of a list or one message.
#pragma once

#include <string>

#include "schema/run.h"

namespace mdof::daemon {

// As JSON, well under a reply's bytes: of one that is longer the note and the notices are cut, its
// options are null, and "shortened" says so.
std::string header_item(const RunHeader& header);
RunHeader shortened(RunHeader header);

}  // namespace mdof::daemon
