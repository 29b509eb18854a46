// A simulated device behind real sockets, on a thread of its own.
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
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/simulated_device.h"

namespace mdof::drivers {

// Listens from the beginning on, on free ports; serves from serve() on until it goes.
class ServedDevice {
 public:
  explicit ServedDevice(std::size_t ports) {
    for (std::size_t i = 0; i < ports; ++i) listeners_.push_back(listen_somewhere());
  }
  ~ServedDevice() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    for (const auto& client : clients_) ::close(client.fd);
    for (const auto& listener : listeners_) ::close(listener.fd);
  }
  ServedDevice(const ServedDevice&) = delete;
  ServedDevice& operator=(const ServedDevice&) = delete;

  int port(std::size_t index) const { return listeners_[index].port; }
  void serve(std::unique_ptr<SimulatedDevice> device) {
    device_ = std::move(device);
    thread_ = std::thread([this] {
      while (!stop_) turn();
    });
  }

 private:
  struct Listener {
    int fd, port;
  };
  struct Client {
    int fd, id;
    std::size_t port;
  };

  static Listener listen_somewhere() {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(fd, any, size), 0);
    EXPECT_EQ(::listen(fd, 8), 0);
    EXPECT_EQ(::getsockname(fd, any, &size), 0);
    return {fd, ::ntohs(address.sin_port)};
  }
  static std::int64_t now_ns() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
  }

  void turn() {
    std::vector<pollfd> wait;
    for (const auto& listener : listeners_) wait.push_back({listener.fd, POLLIN, 0});
    for (const auto& client : clients_) wait.push_back({client.fd, POLLIN, 0});
    ::poll(wait.data(), wait.size(), 1);
    for (std::size_t i = 0; i < listeners_.size(); ++i) accept_at(i);
    std::vector<Client> still;
    for (const Client& client : clients_)
      if (exchange(client)) still.push_back(client);
    clients_ = std::move(still);
  }
  void accept_at(std::size_t index) {
    const int fd = ::accept4(listeners_[index].fd, nullptr, nullptr, SOCK_CLOEXEC);
    if (fd < 0) return;
    clients_.push_back({fd, next_id_++, index});
    device_->opened(index, clients_.back().id, now_ns());
  }
  // False: it has gone, or was broken off.
  bool exchange(const Client& client) {
    std::array<char, 4096> bytes;
    const ssize_t n = ::recv(client.fd, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (n == 0 || (n < 0 && errno != EAGAIN)) return leave(client);
    const std::string_view received(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    const std::string answer = device_->exchange(client.port, client.id, received, now_ns());
    if (!answer.empty()) ::send(client.fd, answer.data(), answer.size(), MSG_NOSIGNAL);
    if (!device_->hangs_up(client.port, client.id)) return true;
    const linger at_once{1, 0};  // closing is a reset then
    ::setsockopt(client.fd, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    return leave(client);
  }
  bool leave(const Client& client) {
    device_->closed(client.port, client.id);
    ::close(client.fd);
    return false;
  }

  std::vector<Listener> listeners_;
  std::vector<Client> clients_;  // of the thread, once it runs
  std::unique_ptr<SimulatedDevice> device_;
  std::atomic<bool> stop_ = false;
  int next_id_ = 1;
  std::thread thread_;
};

}  // namespace mdof::drivers
