#include "daemon/store/file/writer_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace mdof::store {
namespace {

namespace fs = std::filesystem;

// Offsets of the locked bytes. They are far beyond the end of the database, and beyond the bytes
// that SQLite locks (at 1 GiB).
constexpr off_t kWriterByte = off_t{1} << 62;
constexpr off_t kOpenRunsByte = kWriterByte + 1;

// A lock that belongs to the open file, not to the process. Two stores in one process therefore
// exclude each other, too.
struct flock one_byte(off_t byte, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return lock;
}

// Descriptors of databases that are not in use now. They are never closed: when a process closes
// any descriptor of a file, the locks that SQLite holds in this process on this file are released.
// A child process has its own list, because a descriptor from the parent process shares the lock
// with the parent.
class Idle {
 public:
  int take(const struct stat& file, int access) {
    const std::lock_guard guard(mutex_);
    auto& of_file = idle_[{::getpid(), file.st_dev, file.st_ino, access}];
    if (of_file.empty()) return -1;
    const int fd = of_file.back();
    of_file.pop_back();
    return fd;
  }
  void put(int fd) {
    struct stat file {};
    if (::fstat(fd, &file) != 0) return;
    const std::lock_guard guard(mutex_);
    idle_[{::getpid(), file.st_dev, file.st_ino, ::fcntl(fd, F_GETFL) & O_ACCMODE}].push_back(fd);
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<pid_t, dev_t, ino_t, int>, std::vector<int>> idle_;
};

Idle& idle() {
  static Idle descriptors;
  return descriptors;
}

// A descriptor of the file that has this path now. With O_CREAT, a missing file is created.
int descriptor_of(const fs::path& database, int flags) {
  struct stat file {};
  if (::stat(database.c_str(), &file) == 0) {
    const int fd = idle().take(file, flags & O_ACCMODE);
    if (fd >= 0) return fd;
  }
  return ::open(database.c_str(), flags | O_CLOEXEC, 0644);
}

tl::unexpected<Error> not_opened(const fs::path& database) {
  return io_error(database.string() + ": cannot be opened for writing: " + std::strerror(errno) +
                  "; the database and its folder must be writable: check the owner, the mode, and "
                  "whether the file system is mounted read-only; or give another database");
}

tl::unexpected<Error> not_locked(const std::string& database) {
  return io_error(database + ": cannot be locked: " + std::strerror(errno) +
                  "; keep the database on a local file system");
}

}  // namespace

WriterLock::WriterLock(WriterLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

WriterLock& WriterLock::operator=(WriterLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

WriterLock::~WriterLock() {
  if (fd_ < 0) return;
  for (const off_t byte : {kOpenRunsByte, kWriterByte}) {
    struct flock release = one_byte(byte, F_UNLCK);
    (void)::fcntl(fd_, F_OFD_SETLK, &release);
  }
  idle().put(fd_);
}

Result<WriterLock> WriterLock::acquire(const fs::path& database, int timeout_ms) {
  // Nothing is written with this descriptor. The flag O_APPEND distinguishes this descriptor from
  // the descriptors of SQLite for sqlite::is_open_for_writing().
  WriterLock lock(descriptor_of(database, O_CREAT | O_RDWR | O_APPEND));
  if (lock.fd_ < 0) return not_opened(database);
  constexpr int kStepMs = 10;
  for (int waited_ms = 0;; waited_ms += kStepMs) {
    struct flock request = one_byte(kWriterByte, F_WRLCK);
    if (::fcntl(lock.fd_, F_OFD_SETLK, &request) == 0) return lock;
    if (errno != EAGAIN && errno != EACCES) return not_locked(database.string());
    if (waited_ms >= timeout_ms) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
  return fail(ErrorCode::conflict,
              database.string() +
                  ": another program (perhaps mdofd) is writing this database, and only one "
                  "program can write; wait until that program ends, or give another database");
}

bool WriterLock::held_byte(const fs::path& database, std::int64_t byte) {
  const WriterLock file(descriptor_of(database, O_RDONLY));
  if (file.fd_ < 0) return false;
  struct flock question = one_byte(byte, F_RDLCK);
  return ::fcntl(file.fd_, F_OFD_GETLK, &question) == 0 && question.l_type != F_UNLCK;
}

bool WriterLock::held(const fs::path& database) {
  return held_byte(database, kWriterByte);
}

Status WriterLock::claim_open_runs() {
  struct flock request = one_byte(kOpenRunsByte, F_WRLCK);
  if (::fcntl(fd_, F_OFD_SETLK, &request) == 0) return {};
  return not_locked("the database");
}

bool WriterLock::open_runs_claimed(const fs::path& database) {
  return held_byte(database, kOpenRunsByte);
}

}  // namespace mdof::store
