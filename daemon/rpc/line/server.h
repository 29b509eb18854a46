// Accepts clients of a service on Unix and TCP sockets. Each line is one message.
// daemon/rpc/README.md describes the protocol.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "daemon/rpc/net/event_loop.h"
#include "daemon/rpc/session/service.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound: use the server on the thread of the loop, or while the loop does not run. The
// service and the loop must exist longer than the server.
class LineServer {
 public:
  LineServer(EventLoop& loop, Service& service);
  // Closes all connections and removes its socket files.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  // Creates a Unix socket with mode 0660. Replaces the socket file of a daemon that no longer runs.
  // Error (conflict): a daemon answers on the socket.
  Status listen_unix(const std::string& path);
  // Uses a Unix or TCP socket that already listens, for example from sd_listen_fds(). Takes
  // ownership unless it returns an error.
  Status listen_fd(int fd);
  // `address` is "127.0.0.1" or "::1", because only programs on this machine may connect. Port 0
  // selects a free port. Returns the port.
  Result<std::uint16_t> listen_tcp(const std::string& address, std::uint16_t port);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
