// Serves a simulated device on a TCP port of this machine from a thread of its own.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "drivers/simulated_device.h"

namespace mdof::drivers {

class ServedDevice {
 public:
  explicit ServedDevice(SimulatedDevice& device) : device_(device) {
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(listener_, plain, size), 0);
    EXPECT_EQ(::listen(listener_, 4), 0);
    EXPECT_EQ(::getsockname(listener_, plain, &size), 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~ServedDevice() {
    stop_ = true;
    thread_.join();
    ::close(listener_);
  }
  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  static std::int64_t now_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  void serve() {
    while (!stop_) {
      std::vector<pollfd> polled = {{listener_, POLLIN, 0}};
      for (const int fd : clients_) polled.push_back({fd, POLLIN, 0});
      ::poll(polled.data(), polled.size(), 1);
      for (std::size_t i = 1; i < polled.size(); ++i) turn(polled[i].fd, polled[i].revents != 0);
      if (polled[0].revents != 0) accept();
    }
    while (!clients_.empty()) drop(clients_.back());
  }
  void accept() {
    clients_.push_back(::accept(listener_, nullptr, nullptr));
    device_.opened(0, clients_.back(), now_ns());
  }
  void turn(int fd, bool readable) {
    std::array<char, 1024> bytes;
    const ssize_t n = readable ? ::recv(fd, bytes.data(), bytes.size(), 0) : 0;
    if (readable && n <= 0) return drop(fd);
    const auto reply =
        device_.exchange(0, fd, {bytes.data(), static_cast<std::size_t>(n)}, now_ns());
    if (!reply.empty()) ::send(fd, reply.data(), reply.size(), MSG_NOSIGNAL);
    if (device_.hangs_up(0, fd)) drop(fd);
  }
  void drop(int fd) {
    device_.closed(0, fd);
    ::close(fd);
    std::erase(clients_, fd);
  }

  SimulatedDevice& device_;
  int listener_ = -1, port_ = 0;
  std::vector<int> clients_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers
