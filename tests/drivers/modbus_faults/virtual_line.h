// A line to a device and a clock that exist only in memory. Line and clock answer the system calls
// of libmodbus and ByteStream for one marked descriptor; waiting takes no real time. Other
// descriptors and threads use the real system (system_calls.h).
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace mdof::drivers {

class VirtualLine;

// The virtual clock of this thread, and its line (nullptr if it has none).
struct VirtualWorld {
  bool active = false;
  std::int64_t now_ns = 0;
  VirtualLine* line = nullptr;
};
inline thread_local VirtualWorld world;

class VirtualLine {
 public:
  // The tested program writes bytes to the descriptor; `sent` is called with these bytes. The
  // program must close the descriptor.
  explicit VirtualLine(std::function<void(VirtualLine&, std::string_view)> sent)
      : fd_(::open("/dev/null", O_RDWR | O_CLOEXEC)), sent_(std::move(sent)) {
    world.line = this;
  }
  ~VirtualLine() {
    if (world.line == this) world.line = nullptr;
  }
  VirtualLine(const VirtualLine&) = delete;
  VirtualLine& operator=(const VirtualLine&) = delete;

  int fd() const { return fd_; }
  // The bytes arrive at the program at `at_ns`. Calls need not be in the order of their times.
  void deliver(std::int64_t at_ns, std::string bytes) {
    if (!bytes.empty()) arriving_.emplace(at_ns, std::move(bytes));
  }
  // The peer breaks the connection at this time. After that, a read returns 0 bytes, or the error
  // ECONNRESET.
  void hang_up(std::int64_t at_ns, int error) {
    gone_ns_ = at_ns;
    error_ = error;
  }

  bool readable() {
    while (!arriving_.empty() && arriving_.begin()->first <= world.now_ns) {
      inbox_ += arriving_.begin()->second;
      arriving_.erase(arriving_.begin());
    }
    return !inbox_.empty() || gone();
  }
  // Advances the clock until bytes arrive, but not beyond `until_ns`.
  bool wait(std::int64_t until_ns) {
    if (readable()) return true;
    std::int64_t next_ns = gone_ns_;
    if (!arriving_.empty()) next_ns = std::min(next_ns, arriving_.begin()->first);
    world.now_ns = std::max(world.now_ns, std::min(next_ns, until_ns));
    return readable();
  }
  ssize_t take(void* into, std::size_t size) {
    if (!readable()) return errno = EAGAIN, -1;
    if (inbox_.empty()) return error_ == 0 ? 0 : (errno = error_, -1);
    const std::size_t n = inbox_.copy(static_cast<char*>(into), size);
    inbox_.erase(0, n);
    return static_cast<ssize_t>(n);
  }
  ssize_t put(const void* bytes, std::size_t size) {
    if (gone()) return errno = EPIPE, -1;
    sent_(*this, {static_cast<const char*>(bytes), size});
    return static_cast<ssize_t>(size);
  }

 private:
  bool gone() const { return world.now_ns >= gone_ns_; }
  int fd_;
  std::function<void(VirtualLine&, std::string_view)> sent_;
  std::multimap<std::int64_t, std::string> arriving_;
  std::string inbox_;
  std::int64_t gone_ns_ = INT64_MAX;
  int error_ = 0;
};

}  // namespace mdof::drivers
