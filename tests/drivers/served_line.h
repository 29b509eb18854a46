// Serves a simulated device on a pseudo terminal (pty). A separate thread does this.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/simulated_device.h"

namespace mdof::drivers {

// Serves the device on the descriptor `fd` until the device hangs up or `stop` is true.
inline void serve_line(SimulatedDevice& device, int fd, const std::atomic<bool>& stop) {
  device.opened(0, 0, monotonic_ns());
  while (!stop) {
    pollfd p{fd, POLLIN, 0};
    ::poll(&p, 1, 1);
    std::array<char, 4096> bytes;
    const ssize_t n = (p.revents & POLLIN) ? ::read(fd, bytes.data(), bytes.size()) : -1;
    const std::string_view received(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    const std::string reply = device.exchange(0, 0, received, monotonic_ns());
    (void)!::write(fd, reply.data(), reply.size());
    if (device.hangs_up(0, 0)) break;
  }
  device.closed(0, 0);
}

class ServedLine {
 public:
  explicit ServedLine(SimulatedDevice& device) : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) std::abort();
    std::array<char, 64> name;
    if (::ptsname_r(master_, name.data(), name.size()) != 0) std::abort();
    path_ = name.data();
    // This descriptor stays open. Otherwise the line would end when the driver closes its
    // descriptor.
    held_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY);
    ::fcntl(master_, F_SETFL, O_RDWR | O_NONBLOCK);
    thread_ = std::thread([this, &device] { serve_line(device, master_, stop_); });
  }
  ~ServedLine() {
    stop_ = true;
    thread_.join();
    ::close(held_);
    ::close(master_);
  }
  ServedLine(const ServedLine&) = delete;
  ServedLine& operator=(const ServedLine&) = delete;
  const std::string& path() const { return path_; }

 private:
  int master_, held_ = -1;
  std::string path_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mdof::drivers
