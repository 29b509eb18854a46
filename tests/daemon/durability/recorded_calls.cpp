// crash_state_test.py preloads this library into mdofd. It records all calls that change or flush
// a file below the folder MDOF_RECORD_BELOW, in their order, in the file MDOF_RECORD_TO.
// Each record is a line: time_ns op offset length path
// - time_ns: CLOCK_MONOTONIC after the call has returned
// - op: W (pwrite), S (fsync or fdatasync), T (ftruncate; length is the new length) or U (unlink)
// After the line of a W follow its `length` bytes.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <string>

namespace {

std::mutex order;

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int record_file() {
  static const int fd = ::open(std::getenv("MDOF_RECORD_TO"), O_WRONLY | O_APPEND | O_CLOEXEC);
  return fd;
}

std::string path_of(int fd) {
  char target[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  const ssize_t n = ::readlink(link.c_str(), target, sizeof target);
  return n > 0 ? std::string(target, static_cast<std::size_t>(n)) : std::string();
}

void note(char op, long offset, long length, const std::string& path, const void* bytes) {
  static const std::string below = std::getenv("MDOF_RECORD_BELOW");
  if (path.compare(0, below.size(), below) != 0) return;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  char line[PATH_MAX + 100];
  const int n =
      std::snprintf(line, sizeof line, "%ld %c %ld %ld %s\n",
                    now.tv_sec * 1'000'000'000 + now.tv_nsec, op, offset, length, path.c_str());
  const iovec parts[] = {{line, static_cast<std::size_t>(n)},
                         {const_cast<void*>(bytes), bytes ? static_cast<std::size_t>(length) : 0}};
  if (::writev(record_file(), parts, 2) < n)
    std::abort();  // without the record, the test proves nothing
}

}  // namespace

extern "C" {

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  static auto* call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  const std::lock_guard guard(order);
  const ssize_t written = call(fd, bytes, count, at);
  if (written > 0) note('W', at, written, path_of(fd), bytes);
  return written;
}
ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) {
  return pwrite64(fd, bytes, count, at);
}
int fsync(int fd) {
  static auto* call = real<int(int)>("fsync");
  const std::lock_guard guard(order);
  const int answer = call(fd);
  if (answer == 0) note('S', 0, 0, path_of(fd), nullptr);
  return answer;
}
int fdatasync(int fd) {
  static auto* call = real<int(int)>("fdatasync");
  const std::lock_guard guard(order);
  const int answer = call(fd);
  if (answer == 0) note('S', 0, 0, path_of(fd), nullptr);
  return answer;
}
int ftruncate64(int fd, off64_t length) noexcept {
  static auto* call = real<int(int, off64_t)>("ftruncate64");
  const std::lock_guard guard(order);
  const int answer = call(fd, length);
  if (answer == 0) note('T', 0, length, path_of(fd), nullptr);
  return answer;
}
int ftruncate(int fd, off_t length) noexcept {
  return ftruncate64(fd, length);
}
int unlink(const char* path) noexcept {
  static auto* call = real<int(const char*)>("unlink");
  const std::lock_guard guard(order);
  const int answer = call(path);
  if (answer == 0) note('U', 0, 0, path, nullptr);
  return answer;
}

}  // extern "C"
