#include "schema/base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace mdof {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t limit_bytes) {
  // O_NONBLOCK: a pipe that nobody writes to is not waited for.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat status {};
  if (in.get() < 0 || ::fstat(in.get(), &status) != 0)
    return bad_input(file.string() + ": cannot be read: " + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) return bad_input(file.string() + ": is a folder; name a file");
  if (!S_ISREG(status.st_mode))
    return bad_input(file.string() + ": is a pipe or a device; name a regular file");
  std::string text;  // no larger than the file: its owner may keep it
  std::array<char, 16 * 1024> piece;
  while (text.size() <= limit_bytes) {
    const ssize_t n = ::read(in.get(), piece.data(), piece.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return bad_input(file.string() + ": cannot be read: " + std::strerror(errno));
    if (n == 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(n));
  }
  return bad_input(file.string() + ": larger than " + std::to_string(limit_bytes) +
                   " bytes; this is not the file meant");
}

}  // namespace mdof
