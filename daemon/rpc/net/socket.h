// Listening sockets. Private header.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "schema/base/result.h"

namespace mdof::rpc {

// Owns a descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

std::string system_error_text(int number);

// Non-blocking and listening. Mode 0660. Replaces a socket file on which no process answers.
Result<Descriptor> listen_on_unix(const std::string& path);
// 127.0.0.1 or ::1; port 0: any.
Result<Descriptor> listen_on_tcp(const std::string& address, std::uint16_t port);
// Error: usage, if the descriptor is no listening stream socket of these kinds. Does not take
// ownership.
Status check_listening(int fd);
std::uint16_t port_of(int socket);

// Blocking. The error is errno; the caller makes its message.
tl::expected<Descriptor, int> connect_to_unix(const std::string& path);
// Errors: usage, if the path does not fit into a socket address.
Status check_unix_path(const std::string& path);

}  // namespace mdof::rpc
