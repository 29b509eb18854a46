// Transmits the messages of a session as lines over a socket, within limits that protect the other
// clients. Private header.
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

// Thread-bound: the event loop. All longer work (receiving, requests, sending) is done in
// take_turn(), which the server calls in a fair order. Other events only ask for a turn, so that a
// handler never runs inside another handler.
class Connection final : public ClientSocket {
 public:
  Connection(ServerCore& server, int socket);  // takes ownership; the socket is connected and
                                               // non-blocking

  // Call one of these two first.
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
  std::optional<LineBuffer::Line> line_;  // in progress; valid because nothing is read meanwhile
  FairShare share_;
  std::optional<Clock::time_point> line_since_;      // begin of an incomplete line
  std::optional<Clock::time_point> draining_since_;  // further input is discarded
};

}  // namespace mdof::rpc
