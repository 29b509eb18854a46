// A SimulatedDevice on a real socket or pty, served by a thread of its own.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
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

// Talks to one client on `fd` until it goes, the device hangs up, or `stop`.
inline void serve_client(SimulatedDevice& device, int fd, int client, bool pty,
                         const std::atomic<bool>& stop) {
  device.opened(0, client, monotonic_ns());
  while (!stop) {
    pollfd p{fd, POLLIN, 0};
    ::poll(&p, 1, 1);
    std::array<char, 4096> bytes;
    const ssize_t n = (p.revents & POLLIN) ? ::read(fd, bytes.data(), bytes.size()) : -1;
    if (n == 0 && !pty) break;
    const std::string_view received(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    const std::string reply = device.exchange(0, client, received, monotonic_ns());
    const ssize_t sent = pty ? ::write(fd, reply.data(), reply.size())
                             : ::send(fd, reply.data(), reply.size(), MSG_NOSIGNAL);
    if ((sent < 0 && !pty) || device.hangs_up(0, client)) break;
  }
  device.closed(0, client);
}

class ServedOverTcp {
 public:
  explicit ServedOverTcp(SimulatedDevice& device) : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_, any, size) != 0 || ::listen(listener_, 4) != 0 ||
        ::getsockname(listener_, any, &size) != 0)
      std::abort();
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, &device] {
      for (int client = 0; !stop_; ++client) {
        pollfd p{listener_, POLLIN, 0};
        if (::poll(&p, 1, 5) <= 0) continue;
        const int fd = ::accept(listener_, nullptr, nullptr);
        serve_client(device, fd, client, false, stop_);
        ::close(fd);
      }
    });
  }
  ~ServedOverTcp() {
    stop_ = true;
    thread_.join();
    ::close(listener_);
  }
  ServedOverTcp(const ServedOverTcp&) = delete;
  ServedOverTcp& operator=(const ServedOverTcp&) = delete;
  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  int listener_, port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class ServedOverPty {
 public:
  explicit ServedOverPty(SimulatedDevice& device) : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) std::abort();
    std::array<char, 64> name;
    if (::ptsname_r(master_, name.data(), name.size()) != 0) std::abort();
    path_ = name.data();
    // Held open, so that the line stays when the driver closes it.
    held_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY);
    ::fcntl(master_, F_SETFL, O_RDWR | O_NONBLOCK);
    thread_ = std::thread([this, &device] { serve_client(device, master_, 0, true, stop_); });
  }
  ~ServedOverPty() {
    stop_ = true;
    thread_.join();
    ::close(held_);
    ::close(master_);
  }
  ServedOverPty(const ServedOverPty&) = delete;
  ServedOverPty& operator=(const ServedOverPty&) = delete;
  const std::string& path() const { return path_; }

 private:
  int master_, held_ = -1;
  std::string path_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mdof::drivers
