// A simulated T7 on real sockets of this machine, for tests: two ports, one thread.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/simulated_device.h"

namespace mdof::drivers {

class Served {
 public:
  explicit Served(SimulatedDevice& device) : device_(device) {
    for (std::size_t p = 0; p < device.ports().size(); ++p) listeners_.push_back(listen_any());
    thread_ = std::thread([this] { run(); });
  }
  ~Served() {
    stop_ = true;
    thread_.join();
    for (const Client& c : clients_) ::close(c.fd);
    for (const int fd : listeners_) ::close(fd);
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  int port(std::size_t i) const {
    sockaddr_in at{};
    socklen_t size = sizeof at;
    ::getsockname(listeners_[i], reinterpret_cast<sockaddr*>(&at), &size);
    return ntohs(at.sin_port);
  }
  // What clients have sent to port 0.
  std::string received() {
    const std::lock_guard lock(mutex_);
    return received_;
  }
  // Changes the device between two of its turns.
  void change(const std::function<void()>& act) {
    const std::lock_guard lock(mutex_);
    act();
  }
  // Breaks all connections.
  void cut() {
    const std::lock_guard lock(mutex_);
    for (Client& c : clients_) c.gone = true;
  }

 private:
  struct Client {
    int fd, id;
    std::size_t port;
    bool gone = false;
  };

  static int listen_any() {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(fd, reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
    EXPECT_EQ(::listen(fd, 8), 0);
    return fd;
  }
  static std::int64_t now_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  void run() {
    while (!stop_) {
      std::vector<pollfd> fds;
      for (const int fd : listeners_) fds.push_back({fd, POLLIN, 0});
      for (const Client& c : clients_) fds.push_back({c.fd, POLLIN, 0});
      ::poll(fds.data(), fds.size(), 1);
      const std::lock_guard lock(mutex_);
      accept_all();
      for (Client& c : clients_) serve(c);
      drop_gone();
    }
  }
  void accept_all() {
    for (std::size_t p = 0; p < listeners_.size(); ++p) {
      const int fd = ::accept4(listeners_[p], nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (fd < 0) continue;
      clients_.push_back({fd, ++last_id_, p});
      device_.opened(p, last_id_, now_ns());
    }
  }
  void serve(Client& c) {
    std::array<char, 4096> in;
    const ssize_t n = ::recv(c.fd, in.data(), in.size(), 0);
    if (n == 0) c.gone = true;
    const std::string got(in.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    if (c.port == 0) received_ += got;
    const std::string out = device_.exchange(c.port, c.id, got, now_ns());
    if (!out.empty()) (void)!::send(c.fd, out.data(), out.size(), MSG_NOSIGNAL);
    c.gone = c.gone || device_.hangs_up(c.port, c.id);
  }
  void drop_gone() {
    for (std::size_t i = clients_.size(); i-- > 0;) {
      if (!clients_[i].gone) continue;
      ::close(clients_[i].fd);
      device_.closed(clients_[i].port, clients_[i].id);
      clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  SimulatedDevice& device_;
  std::vector<int> listeners_;
  std::vector<Client> clients_;
  int last_id_ = 0;
  std::string received_;
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers
