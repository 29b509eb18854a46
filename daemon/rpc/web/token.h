// The token of browsers that may write: 256 random bits in a file that only mdofd's user can read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

// The token in `file`, which is created (mode 0600) if missing. Errors: io; check: others can read
// the file, or it contains no token.
Result<std::string> load_token(const std::filesystem::path& file);
// The same, but does not create the file.
Result<std::string> read_token(const std::filesystem::path& file);

// Whether this is "Bearer TOKEN". Takes the same time for all wrong tokens of the same length.
bool bears_token(std::string_view authorization, std::string_view token);

}  // namespace mdof::rpc
