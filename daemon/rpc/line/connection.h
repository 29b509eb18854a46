// One client: lines in, replies and notifications out, and the limits that keep it from harming
// the others. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/caller.h"
#include "daemon/rpc/exchange.h"
#include "daemon/rpc/line/asio.h"
#include "daemon/rpc/line/line_buffer.h"
#include "daemon/rpc/line/outbox.h"
#include "daemon/rpc/topic_hub.h"

namespace mdof::rpc {

struct ServerCore;

// Thread-bound: the loop. All progress is made in pump(); whatever else happens asks for a pump, so
// that a handler never runs inside another.
class Connection final : public Caller,
                         public LineSink,
                         public Subscriber,
                         public std::enable_shared_from_this<Connection> {
 public:
  using Clock = std::chrono::steady_clock;

  // Takes the connected, non-blocking socket. `kept_place`: it has that of the machine's control.
  Connection(ServerCore& server, int socket, bool kept_place);

  void start();
  void pump();
  void check_times(Clock::time_point now);
  void close();  // at once; the server forgets it

  std::optional<Credentials> credentials() const override { return credentials_; }
  bool may_write() const override;
  bool in_group(gid_t group) const override;
  bool has_kept_place() const { return kept_place_; }
  Status subscribe(std::string_view topic, std::chrono::milliseconds interval) override;
  Status unsubscribe(std::string_view topic) override;
  void finish(std::string_view line) override;
  void wake() override;

 private:
  enum class State { open, draining, closed };

  bool has_room() const;
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
  void end_idle();
  void drain();
  void drop(const std::string& why);
  bool finished();
  std::string name() const;

  ServerCore& server_;
  const bool kept_place_;
  asio::posix::stream_descriptor socket_;
  std::optional<Credentials> credentials_;
  LineBuffer input_;
  Outbox output_;
  State state_ = State::open;
  std::size_t open_exchanges_ = 0;  // lines whose reply comes later
  bool reading_ = false, writing_ = false, pump_posted_ = false;
  bool input_ended_ = false, shut_down_ = false;
  std::optional<Clock::time_point> line_since_;     // a line has begun and not ended
  std::optional<Clock::time_point> stalled_since_;  // unsent output, and the client takes none
  Clock::time_point active_;                        // a request came, or was answered
  Clock::time_point draining_since_;
};

}  // namespace mdof::rpc
