// The JSON-RPC 2.0 server: methods from a table, on sockets, in a loop. README.md has the rules of
// the wire.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/line/event_loop.h"
#include "daemon/rpc/line/server_options.h"
#include "daemon/rpc/method_table.h"
#include "daemon/rpc/topic.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound: every call on the loop's thread, or while the loop does not run; from elsewhere
// through EventLoop::post. The table must outlive the server, the server must go before the loop.
class Server {
 public:
  Server(EventLoop& loop, const MethodTable& table, ServerOptions options = {});
  // Closes all connections and removes its socket files.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Mode 0660. A socket file left by a daemon that is no more is replaced; where one answers, that
  // is an error (conflict).
  Status listen_unix(const std::string& path);
  // An already listening Unix or TCP socket, as from sd_listen_fds(); owns it from then on, unless
  // that is an error.
  Status listen_fd(int fd);
  // Loopback only: "127.0.0.1" or "::1"; port 0 takes a free one. Gives the port.
  Result<std::uint16_t> listen_tcp(const std::string& address, std::uint16_t port);

  void add_topic(Topic topic);
  // How often values are to be made, so that none is made in vain and each subscriber gets a fresh
  // one: at their interval, and as often as the topic allows while one awaits his first or they
  // have asked for different ones. Nothing: nobody has subscribed.
  std::optional<std::chrono::milliseconds> wanted_every(std::string_view topic) const;
  // `json` is one JSON value. Cheap: the value is shared by those who wait for it, and sent in a
  // later turn of the loop. Errors: no such topic, too large for a reply line
  // (subscribers are then told in "missed").
  Status publish(std::string_view topic, std::string json);

  std::size_t connection_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
