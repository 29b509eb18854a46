// The sessions of a service on Unix and TCP sockets, a message a line. README.md has the rules of
// the wire.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "daemon/rpc/net/event_loop.h"
#include "daemon/rpc/session/service.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound: every call on the loop's thread, or while the loop does not run. The service
// outlives it, and so does the loop.
class LineServer {
 public:
  LineServer(EventLoop& loop, Service& service);
  // Closes all connections and removes its socket files.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  // Mode 0660. A socket file left by a daemon that is no more is replaced; where one answers, that
  // is an error (conflict).
  Status listen_unix(const std::string& path);
  // An already listening Unix or TCP socket, as from sd_listen_fds(); owns it from then on, unless
  // that is an error.
  Status listen_fd(int fd);
  // Loopback only: "127.0.0.1" or "::1"; port 0 takes a free one. Gives the port.
  Result<std::uint16_t> listen_tcp(const std::string& address, std::uint16_t port);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
