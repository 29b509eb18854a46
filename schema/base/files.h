// Whole small text files (rigs, configurations).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof {

// The file's bytes; an error names the path and what is wrong. Only regular files are read: a pipe
// or a device could keep the caller waiting. Files over `limit_bytes` are refused.
Result<std::string> read_text_file(const std::filesystem::path& file,
                                   std::size_t limit_bytes = std::size_t{4} << 20);

}  // namespace mdof
