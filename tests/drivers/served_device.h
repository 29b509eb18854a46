// Serves a simulated device on real sockets of this machine. A separate thread does this.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/clock/monotonic.h"
#include "drivers/simulated_device.h"

namespace mdof::drivers {

// The ports are open after construction. The device is served from serve() to the destructor.
class ServedDevice {
 public:
  explicit ServedDevice(std::size_t ports) {
    for (std::size_t i = 0; i < ports; ++i) listeners_.push_back(listen_somewhere());
  }
  // Opens a socket for each port of the device and serves immediately.
  explicit ServedDevice(SimulatedDevice& device) : ServedDevice(device.ports().size()) {
    serve(device);
  }
  ~ServedDevice() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    for (const Client& client : clients_) ::close(client.fd);
    for (const Listener& listener : listeners_) ::close(listener.fd);
  }
  ServedDevice(const ServedDevice&) = delete;
  ServedDevice& operator=(const ServedDevice&) = delete;

  // The device must outlive this object.
  void serve(SimulatedDevice& device) {
    device_ = &device;
    thread_ = std::thread([this] {
      while (!stop_) turn();
    });
  }

  int port(std::size_t index = 0) const { return listeners_[index].port; }
  std::string address(std::size_t index = 0) const {
    return "127.0.0.1:" + std::to_string(port(index));
  }
  // All bytes that clients have sent to port 0.
  std::string received() {
    const std::lock_guard lock(mutex_);
    return received_;
  }
  // Calls `act` while the device is not being served, so that `act` may change the device.
  void change(const std::function<void()>& act) {
    const std::lock_guard lock(mutex_);
    act();
  }
  // Breaks all connections.
  void cut() {
    const std::lock_guard lock(mutex_);
    for (Client& client : clients_) client.gone = true;
  }

 private:
  struct Listener {
    int fd, port;
  };
  struct Client {
    int fd, id;
    std::size_t port;
    bool gone = false;
  };

  static Listener listen_somewhere() {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(fd, any, size), 0);
    EXPECT_EQ(::listen(fd, 8), 0);
    EXPECT_EQ(::getsockname(fd, any, &size), 0);
    return {fd, ntohs(address.sin_port)};
  }

  void turn() {
    std::vector<pollfd> polled;
    for (const Listener& listener : listeners_) polled.push_back({listener.fd, POLLIN, 0});
    for (const Client& client : clients_) polled.push_back({client.fd, POLLIN, 0});
    ::poll(polled.data(), polled.size(), 1);
    const std::lock_guard lock(mutex_);
    for (std::size_t port = 0; port < listeners_.size(); ++port) accept_at(port);
    for (Client& client : clients_) exchange(client);
    drop_gone();
  }
  void accept_at(std::size_t port) {
    const int fd = ::accept4(listeners_[port].fd, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) return;
    clients_.push_back({fd, next_id_++, port});
    device_->opened(port, clients_.back().id, monotonic_ns());
  }
  void exchange(Client& client) {
    std::array<char, 4096> bytes;
    const ssize_t n = ::recv(client.fd, bytes.data(), bytes.size(), 0);
    if (n == 0 || (n < 0 && errno != EAGAIN)) client.gone = true;
    if (client.gone) return;
    const std::string_view got(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    if (client.port == 0) received_ += got;
    const std::string reply = device_->exchange(client.port, client.id, got, monotonic_ns());
    if (!reply.empty()) (void)!::send(client.fd, reply.data(), reply.size(), MSG_NOSIGNAL);
    client.gone = device_->hangs_up(client.port, client.id);
  }
  void drop_gone() {
    for (const Client& client : clients_) {
      if (!client.gone) continue;
      device_->closed(client.port, client.id);
      ::close(client.fd);
    }
    std::erase_if(clients_, [](const Client& client) { return client.gone; });
  }

  std::vector<Listener> listeners_;
  SimulatedDevice* device_ = nullptr;
  std::vector<Client> clients_;  // mutex_ protects the clients and the device
  std::string received_;
  std::mutex mutex_;
  int next_id_ = 1;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers
