// Are the recordings and logs that the runs of a database were made from still what they were?
#pragma once

#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::daemon {

struct SourceCheck {
  std::vector<std::string> findings;  // one sentence for each file that is gone or another
  Notices notices;                    // what cannot be checked, and why: nothing is wrong with it
};

// Reads every file once, to its end, in pieces. Errors: as of a database that is read.
Result<SourceCheck> verify_sources(store::Store& store);

}  // namespace mdof::daemon
