// The text of a run that mdofd has stored, as `mdof show` prints it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/rpc/line/client.h"

namespace mdof::tools {

// Reads the run from the database of the daemon. nullopt: this process cannot read it, for example
// because it belongs to another user.
std::optional<std::string> stored_run_text(rpc::Client& daemon, std::int64_t run);

}  // namespace mdof::tools
