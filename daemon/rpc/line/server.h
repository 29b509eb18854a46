// Serves the sessions of a service on Unix and TCP sockets, one message a line. README.md describes
// the protocol.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "daemon/rpc/net/event_loop.h"
#include "daemon/rpc/session/service.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound: call it on the loop's thread, or while the loop does not run. The service and the
// loop must outlive it.
class LineServer {
 public:
  LineServer(EventLoop& loop, Service& service);
  // Closes all connections and removes its socket files.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  // Mode 0660. Replaces the socket file of a daemon that no longer runs. Error (conflict): a daemon
  // answers on the socket.
  Status listen_unix(const std::string& path);
  // A socket that already listens (Unix or TCP), for example from sd_listen_fds(). Takes ownership
  // unless it returns an error.
  Status listen_fd(int fd);
  // Loopback only: "127.0.0.1" or "::1"; port 0 selects a free one. Returns the port.
  Result<std::uint16_t> listen_tcp(const std::string& address, std::uint16_t port);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
