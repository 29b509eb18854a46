// Carries the messages of a session as lines over a socket, within the limits that keep a client
// from harming the others. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/fair_order.h"
#include "daemon/rpc/line/line_buffer.h"
#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/outbox.h"
#include "daemon/rpc/session/session.h"

namespace mdof::rpc {

struct ServerCore;

// Thread-bound: the loop. All that takes time (receiving, requests, sending) is done in
// take_turn(), which the server calls in an order that is fair; whatever else happens asks for a
// turn, so that a handler never runs inside another.
class Connection final : public Transport, public std::enable_shared_from_this<Connection> {
 public:
  using Clock = std::chrono::steady_clock;

  Connection(ServerCore& server, int socket);  // takes it; connected and non-blocking

  // One of the two comes first.
  void start(std::shared_ptr<Session> session);
  void turn_away(std::string_view why);

  void take_turn();
  FairShare& share() { return share_; }
  void check_times(Clock::time_point now);
  void close();  // at once; the server forgets it

  bool has_subscriptions() const { return session_ && session_->has_subscriptions(); }

  void send(std::string_view message) override;
  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 private:
  enum class State { open, draining, closed };

  void pump();
  void run_lines();
  bool next_line();
  void take_line(Clock::time_point until);
  void flush();
  void send_due();
  void wait();
  void wait_readable();
  void wait_writable();
  void receive();
  void input_ended();
  void refuse(std::string_view why);
  void drain();
  void drop(const std::string& why);
  bool finished();
  void go_on();

  ServerCore& server_;
  asio::posix::stream_descriptor socket_;
  std::shared_ptr<Session> session_;  // until closed: it has a place as long as it is held
  LineBuffer input_;
  std::optional<LineBuffer::Line> line_;  // being taken; valid as nothing is read meanwhile
  Outbox output_;
  State state_ = State::open;
  FairShare share_;
  bool reading_ = false, writing_ = false, readable_ = false, has_turn_ = false;
  bool input_ended_ = false, shut_down_ = false;
  std::optional<Clock::time_point> line_since_;     // a line has begun and not ended
  std::optional<Clock::time_point> stalled_since_;  // unsent output, and the client takes none
  Clock::time_point draining_since_;
};

}  // namespace mdof::rpc
