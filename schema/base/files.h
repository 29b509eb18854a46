// Files that are read whole: small ones as text (rigs, configurations), large ones in pieces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof {

// The file's bytes; an error names the path and what is wrong. Only regular files are read: a pipe
// or a device could keep the caller waiting. Files over `limit_bytes` are refused.
Result<std::string> read_text_file(const std::filesystem::path& file,
                                   std::size_t limit_bytes = std::size_t{4} << 20);

// The same for a file of any size, handed on in pieces of up to 1 MiB. An error of `take` ends it.
Status read_in_pieces(const std::filesystem::path& file,
                      const std::function<Status(std::string_view)>& take);

}  // namespace mdof
