// Checks that the recordings and logs of all stored runs exist and have not changed.
#pragma once

#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::daemon {

struct SourceCheck {
  std::vector<std::string> findings;  // one sentence for each file that is missing or has changed
  Notices notices;  // files that cannot be checked, with the reason; they are not in `findings`
};

// Reads every file completely. Error: the database cannot be read.
Result<SourceCheck> verify_sources(store::Store& store);

}  // namespace mdof::daemon
