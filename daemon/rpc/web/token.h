// The token of browsers that may write: 256 random bits in a file that only mdofd's user can read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

// The token in `file`, which is made (mode 0600) where it is not there. Errors: io; check: others
// can read the file, or it holds no token.
Result<std::string> load_token(const std::filesystem::path& file);
// The same without making one.
Result<std::string> read_token(const std::filesystem::path& file);

// Whether this is "Bearer TOKEN". Takes the same time for every wrong token of that length.
bool bears_token(std::string_view authorization, std::string_view token);

}  // namespace mdof::rpc
