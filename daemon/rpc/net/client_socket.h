// The socket of a connection of either kind (line/connection.h, web/http_connection.h): pending
// output, readiness events of the loop, and one turn at a time. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/outbox.h"
#include "daemon/rpc/session/session.h"

namespace mdof::rpc {

// Thread-bound: the event loop.
class ClientSocket : public Transport, public std::enable_shared_from_this<ClientSocket> {
 public:
  using Clock = std::chrono::steady_clock;

  void take_turn();
  void close();  // immediately; the server forgets the connection

  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 protected:
  ClientSocket(asio::io_context& context, int socket);  // takes ownership; connected and
                                                        // non-blocking

  virtual void request_turn() = 0;
  virtual void forget() = 0;   // called when the socket is closed
  virtual void receive() = 0;  // called when data can be read
  virtual void pump() = 0;     // the rest of a turn

  void flush();
  void wait_readable();
  void wait_writable();
  void end_output();  // once; input can still be read
  bool hung_up();     // the client has closed both directions

  asio::posix::stream_descriptor socket_;
  std::shared_ptr<Session> session_;  // reset on closing, because a session occupies a place
  Outbox output_;
  bool closed_ = false, input_ended_ = false;
  bool reading_ = false, writing_ = false, has_turn_ = false;
  std::optional<Clock::time_point> stalled_since_;  // since then the client takes none of the
                                                    // unsent output

 private:
  bool readable_ = false, shut_down_ = false;
};

}  // namespace mdof::rpc
