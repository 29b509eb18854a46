#include "daemon/store/file/told_head.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace mdof::store {

namespace fs = std::filesystem;

fs::path told_head_file(const fs::path& database) {
  std::error_code ec;
  const fs::path real = fs::canonical(database, ec);
  return (ec ? database : real).string() + ".head";
}

ToldHead read_told_head(const fs::path& database) {
  constexpr std::size_t kSha256Digits = 64;
  ToldHead told;
  std::ifstream in(told_head_file(database));
  if (in >> told.head.link >> told.head.sha256 >> told.generation && told.head.link > 0 &&
      told.head.sha256.size() == kSha256Digits)
    return told;
  return {};
}

Status write_told_head(const fs::path& database, const ToldHead& told) {
  const fs::path file = told_head_file(database), fresh = file.string() + ".new";
  errno = 0;
  std::ofstream out(fresh, std::ios::trunc);
  out << told.head.link << ' ' << told.head.sha256 << ' ' << told.generation << std::endl;
  std::error_code ec;
  if (out.good()) fs::rename(fresh, file, ec);
  if (out.good() && !ec) return {};
  return io_error(file.string() + ": cannot be written: " +
                  (ec ? ec.message() : std::strerror(errno ? errno : EIO)));
}

}  // namespace mdof::store
