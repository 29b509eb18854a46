// What a connection of either kind (line/connection.h, web/http_connection.h) has of its socket:
// output that waits, the loop's word that it can be read or written, one turn at a time. Private
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

// Thread-bound: the loop.
class ClientSocket : public Transport, public std::enable_shared_from_this<ClientSocket> {
 public:
  using Clock = std::chrono::steady_clock;

  void take_turn();
  void close();  // at once; the server forgets it

  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 protected:
  ClientSocket(asio::io_context& context, int socket);  // takes it; connected and non-blocking

  virtual void ask_for_turn() = 0;
  virtual void forget() = 0;   // it is closed
  virtual void receive() = 0;  // there is something to be read
  virtual void pump() = 0;     // all else that a turn is for

  void flush();
  void wait_readable();
  void wait_writable();
  void end_output();  // once; what the client still sends can be read
  bool hung_up();     // the client has closed both ways

  asio::posix::stream_descriptor socket_;
  std::shared_ptr<Session> session_;  // until closed: it has a place as long as it is held
  Outbox output_;
  bool closed_ = false, input_ended_ = false;
  bool reading_ = false, writing_ = false, has_turn_ = false;
  std::optional<Clock::time_point> stalled_since_;  // unsent output, and the client takes none

 private:
  bool readable_ = false, shut_down_ = false;
};

}  // namespace mdof::rpc
