// Checks that the source recordings and logs of all stored runs still exist and are unchanged.
#pragma once

#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::daemon {

struct SourceCheck {
  std::vector<std::string> findings;  // one sentence for each file that is missing or has changed
  Notices notices;  // files that cannot be checked, with the reason; these are no findings
};

// Reads every file once, completely, in pieces. Errors: those of reading the database.
Result<SourceCheck> verify_sources(store::Store& store);

}  // namespace mdof::daemon
