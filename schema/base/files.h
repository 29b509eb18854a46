// Reads whole files: small ones as text (rigs, configurations), large ones in pieces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof {

// The bytes of the file. An error names the path and the reason. Only regular files are read,
// because a pipe or a device could block the caller. Files over `limit_bytes` are rejected.
Result<std::string> read_text_file(const std::filesystem::path& file,
                                   std::size_t limit_bytes = std::size_t{4} << 20);

// Reads a file of any size in pieces of up to 1 MiB and passes each to `take`. An error of `take`
// ends the reading.
Status read_in_pieces(const std::filesystem::path& file,
                      const std::function<Status(std::string_view)>& take);

}  // namespace mdof
