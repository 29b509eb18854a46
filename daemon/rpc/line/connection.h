// Carries the messages of a session as lines over a socket, within the limits that keep a client
// from harming the others. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/line/line_buffer.h"
#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/outbox.h"
#include "daemon/rpc/session/session.h"

namespace mdof::rpc {

struct ServerCore;

// Thread-bound: the loop. All progress is made in pump(); whatever else happens asks for a pump, so
// that a handler never runs inside another.
class Connection final : public Transport, public std::enable_shared_from_this<Connection> {
 public:
  using Clock = std::chrono::steady_clock;

  Connection(ServerCore& server, int socket);  // takes it; connected and non-blocking

  // One of the two comes first.
  void start(std::shared_ptr<Session> session);
  void turn_away(std::string_view why);

  void pump();
  void check_times(Clock::time_point now);
  void close();  // at once; the server forgets it

  bool has_subscriptions() const { return session_ && session_->has_subscriptions(); }

  void send(std::string_view message) override;
  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 private:
  enum class State { open, draining, closed };

  void run_lines();
  void take_line(const LineBuffer::Line& line, std::size_t& left);
  void flush();
  void send_due();
  void wait();
  void wait_readable();
  void wait_writable();
  void received(const std::error_code& error, std::size_t bytes);
  void input_ended();
  void refuse(std::string_view why);
  void drain();
  void drop(const std::string& why);
  bool finished();

  ServerCore& server_;
  asio::posix::stream_descriptor socket_;
  std::shared_ptr<Session> session_;  // until closed: it has a place as long as it is held
  LineBuffer input_;
  Outbox output_;
  State state_ = State::open;
  bool reading_ = false, writing_ = false, pump_posted_ = false;
  bool input_ended_ = false, shut_down_ = false;
  std::optional<Clock::time_point> line_since_;     // a line has begun and not ended
  std::optional<Clock::time_point> stalled_since_;  // unsent output, and the client takes none
  Clock::time_point draining_since_;
};

}  // namespace mdof::rpc
