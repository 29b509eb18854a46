#include "schema/base/files.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace mdof {

Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t limit_bytes) {
  std::error_code ec;
  if (std::filesystem::is_directory(file, ec)) {
    return bad_input(file.string() + ": is a folder; name a file");
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return bad_input(file.string() + ": cannot be read: " + std::strerror(errno ? errno : EIO));
  }
  std::string text;  // no larger than the file: its owner may keep it
  std::array<char, 16 * 1024> piece;
  while (text.size() <= limit_bytes && in) {
    in.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (text.size() > limit_bytes) {
    return bad_input(file.string() + ": larger than " + std::to_string(limit_bytes) +
                     " bytes; this is not the file meant");
  }
  return text;
}

}  // namespace mdof
