// The token with which browsers may write. It has 256 random bits, and is in a file that only the
// user of mdofd can read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

// Reads the token in `file`. If the file is missing, creates it with a new token and mode 0600.
// Errors: io: reading or writing failed; check: other users can read the file, or it contains no
// token.
Result<std::string> load_token(const std::filesystem::path& file);
// Reads the token in `file`, but does not create the file.
Result<std::string> read_token(const std::filesystem::path& file);

// Whether `authorization` is "Bearer " followed by `token`. The comparison takes the same time for
// all wrong tokens of the same length.
bool bears_token(std::string_view authorization, std::string_view token);

}  // namespace mdof::rpc
