// Base class of connections (line/connection.h, web/http_connection.h). It contains the socket and
// the pending output, waits until the socket can be read or written, and requests turns. Private
// header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/outbox.h"
#include "daemon/rpc/session/session.h"

namespace mdof::rpc {

// Thread-bound to the event loop.
class ClientSocket : public Transport, public std::enable_shared_from_this<ClientSocket> {
 public:
  using Clock = std::chrono::steady_clock;

  void take_turn();
  void close();  // closes at once and removes the connection from the server

  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 protected:
  ClientSocket(asio::io_context& context, int socket);  // takes ownership; connected and
                                                        // non-blocking

  virtual void request_turn() = 0;
  // Called when the socket is closed; removes the connection from the server.
  virtual void forget() = 0;
  virtual void receive() = 0;  // called when data can be read
  virtual void pump() = 0;     // called in each turn after receive()

  void flush();
  void wait_readable();
  void wait_writable();
  void end_output();  // closes the output direction, at most once; input can still be read
  bool hung_up();     // whether the client has closed both directions

  asio::posix::stream_descriptor socket_;
  // Null after closing, because an open session counts as a connected client.
  std::shared_ptr<Session> session_;
  Outbox output_;
  bool closed_ = false, input_ended_ = false;
  bool reading_ = false, writing_ = false, has_turn_ = false;
  // The time since when the client has read none of the unsent output.
  std::optional<Clock::time_point> stalled_since_;

 private:
  bool readable_ = false, shut_down_ = false;
};

}  // namespace mdof::rpc
