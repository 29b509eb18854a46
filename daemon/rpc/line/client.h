// A blocking client for mdof and for tests.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>

#include "daemon/rpc/net/socket.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound. After an io error of any call the connection is of no more use.
class Client {
 public:
  using milliseconds = std::chrono::milliseconds;

  // Errors (io) say how to start the daemon, or which group may use the socket.
  static Result<Client> connect(const std::string& socket_path);

  // `params` is a JSON object or array. Gives the result as JSON text; an error of the server is
  // one with its message (and data), the code being what codes.h makes of it. Notifications that
  // come meanwhile are kept for next_notification().
  Result<std::string> call(std::string_view method, std::string_view params = "{}",
                           milliseconds timeout = milliseconds(30000));
  // One notification, a whole line of JSON. Errors: io, also when none comes in time.
  Result<std::string> next_notification(milliseconds timeout);
  // False once the daemon has closed the connection.
  bool connected() const { return connected_; }

 private:
  using Clock = std::chrono::steady_clock;
  explicit Client(Descriptor socket) : socket_(std::move(socket)) {}
  Status send_line(std::string_view line, Clock::time_point end);
  Result<std::string> read_line(Clock::time_point end);

  Descriptor socket_;
  std::string received_;  // not yet a whole line
  std::deque<std::string> notifications_;
  std::int64_t last_id_ = 0;
  bool connected_ = true;
};

}  // namespace mdof::rpc
