// A run that a daemon stored, as `mdof show` prints it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/rpc/line/client.h"

namespace mdof::tools {

// Read from the database that the daemon says it holds; nothing where that cannot be read from
// here: another user's, for example.
std::optional<std::string> stored_run_text(rpc::Client& daemon, std::int64_t run);

}  // namespace mdof::tools
