// Which database a command means, and who may write it.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::tools {

// `option`: what --db gave; empty: the default of daemon/paths.h.
Result<std::filesystem::path> database_path(const std::string& option);
Result<store::Store> open_to_read(const std::string& option);
Result<store::Store> open_to_write(const std::string& option);

// mdofd, or another mdof, is writing it now.
Result<bool> somebody_writes(const std::string& option);

}  // namespace mdof::tools
