#include "schema/base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

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

// Opens a regular file. The error states why the file cannot be read.
Result<std::unique_ptr<Descriptor>> opened(const std::filesystem::path& file) {
  // With O_NONBLOCK, open() does not wait for the writer of a pipe.
  auto in = std::make_unique<Descriptor>(
      ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat status {};
  if (in->get() < 0 || ::fstat(in->get(), &status) != 0)
    return bad_input(file.string() + ": cannot be read: " + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) return bad_input(file.string() + ": is a folder; give a file");
  if (!S_ISREG(status.st_mode))
    return bad_input(file.string() + ": is a pipe or a device; give a regular file");
  return in;
}

// Reads into `room` and returns the number of bytes; 0 at the end of the file.
Result<std::size_t> read_some(const Descriptor& in, const std::filesystem::path& file, char* room,
                              std::size_t size) {
  for (;;) {
    const ssize_t n = ::read(in.get(), room, size);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EINTR)
      return bad_input(file.string() + ": cannot be read: " + std::strerror(errno));
  }
}

}  // namespace

Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t limit_bytes) {
  MDOF_TRY(const auto in, opened(file));
  // Memory for limit_bytes is not reserved, because most files are much smaller, and the caller may
  // keep the text.
  std::string text;
  std::array<char, 16 * 1024> piece;
  while (text.size() <= limit_bytes) {
    MDOF_TRY(const std::size_t n, read_some(*in, file, piece.data(), piece.size()));
    if (n == 0) return text;
    text.append(piece.data(), n);
  }
  return bad_input(file.string() + ": is larger than " + std::to_string(limit_bytes) +
                   " bytes, the limit for this kind of file; check the name of the file");
}

Status read_in_pieces(const std::filesystem::path& file,
                      const std::function<Status(std::string_view)>& take) {
  MDOF_TRY(const auto in, opened(file));
  std::string room(std::size_t{1} << 20, '\0');
  for (;;) {
    MDOF_TRY(const std::size_t n, read_some(*in, file, room.data(), room.size()));
    if (n == 0) return {};
    MDOF_CHECK(take(std::string_view(room).substr(0, n)));
  }
}

}  // namespace mdof
