// Transmits the messages of a session as lines over a socket. Its limits protect the other clients.
// Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/fair_order.h"
#include "daemon/rpc/line/line_buffer.h"
#include "daemon/rpc/net/client_socket.h"

namespace mdof::rpc {

struct ServerCore;

// Thread-bound to the event loop. Only take_turn() receives, handles requests and sends; the server
// calls it for all connections in a fair order. All other events only ask the server for a turn. A
// handler therefore never runs inside another handler.
class Connection final : public ClientSocket {
 public:
  Connection(ServerCore& server, int socket);  // takes ownership; the socket is connected and
                                               // non-blocking

  // Call either start() or reject_connection() first.
  void start(std::shared_ptr<Session> session);
  void reject_connection(std::string_view why);

  FairShare& share() { return share_; }
  void check_times(Clock::time_point now);

  bool has_subscriptions() const { return session_ && session_->has_subscriptions(); }

  void send(std::string_view message) override;

 private:
  void request_turn() override;
  void forget() override;
  void receive() override;
  void pump() override;
  bool is_open() const { return !closed_ && !draining_since_; }
  void send_all();
  void run_lines();
  bool next_line();
  void take_line(Clock::time_point until);
  void send_due();
  void wait();
  void input_ended();
  void refuse(std::string_view why);
  void drain();
  void drop(const std::string& why);
  bool finished();
  void go_on();

  ServerCore& server_;
  LineBuffer input_;
  std::optional<LineBuffer::Line> line_;  // the line in progress; this line stays valid because the
                                          // connection reads nothing until the line was handled
  FairShare share_;
  std::optional<Clock::time_point> line_since_;      // time of the first byte of an incomplete line
  std::optional<Clock::time_point> draining_since_;  // not nullopt: further input is discarded
};

}  // namespace mdof::rpc
