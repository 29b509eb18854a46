// Reads whole files: small files as text (rigs, configurations), large files in pieces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof {

// Returns the bytes of the file. An error names the path and the reason. Rejects files larger than
// `limit_bytes`, and files that are not regular, because a pipe or a device could block the caller.
Result<std::string> read_text_file(const std::filesystem::path& file,
                                   std::size_t limit_bytes = std::size_t{4} << 20);

// Reads a file of any size in pieces of up to 1 MiB and passes each piece to `take`. If `take`
// returns an error, the function stops and returns this error.
Status read_in_pieces(const std::filesystem::path& file,
                      const std::function<Status(std::string_view)>& take);

}  // namespace mdof
