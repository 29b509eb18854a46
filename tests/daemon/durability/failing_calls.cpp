// failing_call_test.py preloads this library into mdofd. The n-th call that writes or flushes a
// file fails.
// - MDOF_FAIL_CALL: n (the first call is 1)
// - MDOF_FAIL_ERRNO: errno of the failed call
// - MDOF_FAIL_STICKY=1: all later calls fail too
// - MDOF_FAIL_TOLD: a file that is created when the call has failed
// Only the calls that SQLite makes on its files are counted: pwrite, fsync, fdatasync, ftruncate,
// fallocate.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

long number(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

bool fails() {
  static const long wanted = number("MDOF_FAIL_CALL"), error = number("MDOF_FAIL_ERRNO");
  static const bool sticky = number("MDOF_FAIL_STICKY") != 0;
  const long call = ++calls;
  if (wanted == 0 || call < wanted || (call > wanted && !sticky)) return false;
  const char* reported = std::getenv("MDOF_FAIL_TOLD");
  if (call == wanted && reported) ::close(::open(reported, O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  errno = static_cast<int>(error);
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  static auto* call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return fails() ? -1 : call(fd, bytes, count, at);
}
ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) {
  return pwrite64(fd, bytes, count, at);
}
int fsync(int fd) {
  static auto* call = real<int(int)>("fsync");
  return fails() ? -1 : call(fd);
}
int fdatasync(int fd) {
  static auto* call = real<int(int)>("fdatasync");
  return fails() ? -1 : call(fd);
}
int ftruncate64(int fd, off64_t length) noexcept {
  static auto* call = real<int(int, off64_t)>("ftruncate64");
  return fails() ? -1 : call(fd, length);
}
int ftruncate(int fd, off_t length) noexcept {
  return ftruncate64(fd, length);
}

}  // extern "C"
