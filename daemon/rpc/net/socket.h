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

// Returns a non-blocking, listening socket with mode 0660. Replaces a socket file on which no
// process answers.
Result<Descriptor> listen_on_unix(const std::string& path);
// `address` is 127.0.0.1 or ::1. Port 0 selects a free port.
Result<Descriptor> listen_on_tcp(const std::string& address, std::uint16_t port);
// Error (usage): the descriptor is not a Unix or TCP stream socket that listens. Does not take
// ownership.
Status check_listening(int fd);
std::uint16_t port_of(int socket);

// Connects a blocking socket. The error is errno; the caller makes the message.
tl::expected<Descriptor, int> connect_to_unix(const std::string& path);
// Error (usage): the path does not fit into a socket address.
Status check_unix_path(const std::string& path);

}  // namespace mdof::rpc
