#include "daemon/store/writer_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

namespace mdof::store {
namespace {

std::string lock_name(const std::filesystem::path& database) {
  return database.string() + "-lock";
}

// Locks of the open file, not of the process: two stores in one process exclude each other too.
struct flock whole_file(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

WriterLock::WriterLock(WriterLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

WriterLock& WriterLock::operator=(WriterLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

WriterLock::~WriterLock() {
  if (fd_ >= 0) ::close(fd_);
}

Result<WriterLock> WriterLock::acquire(const std::filesystem::path& database, int timeout_ms) {
  const std::string name = lock_name(database);
  WriterLock lock(::open(name.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644));
  if (lock.fd_ < 0)
    return io_error(name + ": cannot be created: " + std::strerror(errno) +
                    ". To store anything the database's folder must be writable: check its owner "
                    "and mode and that its file system is not mounted read-only, or name another");
  constexpr int kStepMs = 10;
  for (int waited_ms = 0;; waited_ms += kStepMs) {
    struct flock request = whole_file(F_WRLCK);
    if (::fcntl(lock.fd_, F_OFD_SETLK, &request) == 0) return lock;
    if (errno != EAGAIN && errno != EACCES)
      return io_error(name + ": cannot be locked: " + std::strerror(errno) +
                      ". Keep the database on a local file system");
    if (waited_ms >= timeout_ms) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
  return fail(ErrorCode::conflict, database.string() +
                                       ": another program (mdofd?) is writing this database, and "
                                       "only one may; wait for it, or name another database");
}

bool WriterLock::held(const std::filesystem::path& database) {
  const WriterLock file(::open(lock_name(database).c_str(), O_RDONLY | O_CLOEXEC));
  if (file.fd_ < 0) return false;
  struct flock question = whole_file(F_RDLCK);
  return ::fcntl(file.fd_, F_OFD_GETLK, &question) == 0 && question.l_type != F_UNLCK;
}

}  // namespace mdof::store
