#include "drivers/csv/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/csv/gunzip.h"
#include "schema/base/database/files.h"

namespace mdof::drivers {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{64} << 10;

std::string text_of(int error) {
  return std::strerror(error);
}

Result<int> open_descriptor(const std::string& path, int given) {
  if (given >= 0) {
    (void)::lseek(given, 0, SEEK_SET);  // fails for a pipe, which is read from where it is
    return ::fcntl(given, F_DUPFD_CLOEXEC, 0);
  }
  if (path == "-") return ::dup(STDIN_FILENO);
  const int descriptor = sqlite::open_foreign(path, 0);
  if (descriptor >= 0) return descriptor;
  const bool is_input = errno == ENOENT || errno == EINVAL;
  return fail(is_input ? ErrorCode::bad_input : ErrorCode::io,
              path + ": cannot be opened: " + sqlite::foreign_error_text(errno) +
                  (errno == EINVAL ? ", or give \"-\" for the standard input" : ""));
}

}  // namespace

Result<std::unique_ptr<ByteSource>> ByteSource::open(const std::string& path, bool hash,
                                                     int given) {
  MDOF_TRY(const int descriptor, open_descriptor(path, given));
  const std::string name = path == "-" ? "standard input" : path;
  if (descriptor < 0) return io_error(name + ": cannot be read: " + text_of(errno));
  struct stat state {};
  const bool known = ::fstat(descriptor, &state) == 0;
  const std::uint64_t size =
      known && S_ISREG(state.st_mode) ? static_cast<std::uint64_t>(state.st_size) : 0;
  std::unique_ptr<ByteSource> source(new ByteSource(descriptor, name, size));
  if (known && S_ISDIR(state.st_mode)) return bad_input(name + ": is a folder; give a CSV file");
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_SEQUENTIAL);
  MDOF_CHECK(source->detect_gzip(hash));
  return source;
}

ByteSource::ByteSource(int descriptor, std::string name, std::uint64_t bytes_total)
    : descriptor_(descriptor),
      name_(std::move(name)),
      bytes_total_(bytes_total),
      buffer_(kBufferBytes) {}

ByteSource::~ByteSource() {
  ::close(descriptor_);
}

Status ByteSource::detect_gzip(bool hash) {
  MDOF_CHECK(refill());
  if (!Gunzip::recognises(pending_)) return {};
  gunzip_ = std::make_unique<Gunzip>();
  if (!hash) return {};
  hash_ = std::make_unique<Sha256>();
  hash_->update(pending_);
  return {};
}

Status ByteSource::refill() {
  MDOF_TRY(const std::size_t count, read_stored(buffer_.data(), buffer_.size()));
  pending_ = {buffer_.data(), count};
  return {};
}

// Fills `to` completely, except at the end of the file, even if a pipe delivers the bytes in small
// pieces.
Result<std::size_t> ByteSource::read_stored(char* to, std::size_t capacity) {
  std::size_t count = 0;
  while (count < capacity) {
    const ssize_t got = ::read(descriptor_, to + count, capacity - count);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return io_error(name_ + ": reading failed after " + std::to_string(bytes_.load()) +
                      " bytes: " + text_of(errno));
    if (got == 0) break;
    if (hash_) hash_->update({to + count, static_cast<std::size_t>(got)});
    count += static_cast<std::size_t>(got);
    bytes_ += static_cast<std::uint64_t>(got);
  }
  return count;
}

Result<std::size_t> ByteSource::read(char* to, std::size_t capacity) {
  if (gunzip_) return read_unpacked(to, capacity);
  if (pending_.empty()) return read_stored(to, capacity);
  const std::size_t count = std::min(capacity, pending_.size());
  std::memcpy(to, pending_.data(), count);
  pending_.remove_prefix(count);
  return count;
}

Result<std::size_t> ByteSource::read_unpacked(char* to, std::size_t capacity) {
  for (;;) {
    if (pending_.empty()) MDOF_CHECK(refill());
    const bool at_end = pending_.empty();
    auto count = gunzip_->unpack(pending_, to, capacity);
    if (!count) return in_context(name_, std::move(count.error()));
    if (*count > 0) return count;
    if (!at_end) continue;
    if (Status status = gunzip_->check_end(); !status)
      return in_context(name_, std::move(status.error()));
    return 0;
  }
}

}  // namespace mdof::drivers
