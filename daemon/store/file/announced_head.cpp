#include "daemon/store/file/announced_head.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace mdof::store {

namespace fs = std::filesystem;

fs::path announced_head_file(const fs::path& database) {
  std::error_code ec;
  const fs::path real = fs::canonical(database, ec);
  return (ec ? database : real).string() + ".head";
}

AnnouncedHead read_announced_head(const fs::path& database) {
  constexpr std::size_t kSha256Digits = 64;
  AnnouncedHead announced;
  std::ifstream in(announced_head_file(database));
  if (in >> announced.head.link >> announced.head.sha256 >> announced.generation &&
      announced.head.link > 0 && announced.head.sha256.size() == kSha256Digits)
    return announced;
  return {};
}

Status write_announced_head(const fs::path& database, const AnnouncedHead& announced) {
  const fs::path file = announced_head_file(database), fresh = file.string() + ".new";
  errno = 0;
  std::ofstream out(fresh, std::ios::trunc);
  out << announced.head.link << ' ' << announced.head.sha256 << ' ' << announced.generation
      << std::endl;
  std::error_code ec;
  if (out.good()) fs::rename(fresh, file, ec);
  if (out.good() && !ec) return {};
  return io_error(file.string() + ": cannot be written: " +
                  (ec ? ec.message() : std::strerror(errno ? errno : EIO)));
}

}  // namespace mdof::store
