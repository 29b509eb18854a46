// A blocking client for mdof and for tests.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>

#include "daemon/rpc/net/socket.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound. Do not use the connection after a call has returned an io error.
class Client {
 public:
  using milliseconds = std::chrono::milliseconds;

  // Error (io): no connection. The message states how to start the daemon, or which group may use
  // the socket.
  static Result<Client> connect(const std::string& socket_path);

  // `params` is a JSON object or array. Returns the result as JSON text. If the server replies with
  // an error, the function returns its message, the remedy in its data, and the ErrorCode from
  // error_code_of(). Notifications that arrive during the call are kept for next_notification().
  Result<std::string> call(std::string_view method, std::string_view params = "{}",
                           milliseconds timeout = milliseconds(30000));
  // Returns one notification, a whole line of JSON. Error (io): no notification arrives before the
  // timeout, or the connection fails.
  Result<std::string> next_notification(milliseconds timeout);
  // False after the daemon has closed the connection.
  bool connected() const { return connected_; }

 private:
  using Clock = std::chrono::steady_clock;
  explicit Client(Descriptor socket) : socket_(std::move(socket)) {}
  Status send_line(std::string_view line, Clock::time_point end);
  Result<std::string> read_line(Clock::time_point end);

  Descriptor socket_;
  std::string received_;  // bytes after the last complete line
  std::deque<std::string> notifications_;
  std::int64_t last_id_ = 0;
  bool connected_ = true;
};

}  // namespace mdof::rpc
