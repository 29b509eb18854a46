// One connection of a browser: requests one after the other, or a stream of events, within the
// limits that keep a client from harming the others. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/outbox.h"
#include "daemon/rpc/session/session.h"
#include "daemon/rpc/web/http_head.h"
#include "daemon/rpc/web/http_reply.h"

namespace mdof::rpc {

struct HttpServerCore;

// Thread-bound: the loop. A request has a session of its own, and so has a stream. Nothing more is
// read until a request is answered and the answer is taken; what waits for a stream stays with
// those who share it (KeptEvents, Subscription), so that a slow browser costs no memory.
class HttpConnection final : public Transport, public std::enable_shared_from_this<HttpConnection> {
 public:
  using Clock = std::chrono::steady_clock;

  HttpConnection(HttpServerCore& server, int socket);  // takes it; connected and non-blocking

  void start() { wait_readable(); }
  void turn_away();
  void take_turn();
  void check_times(Clock::time_point now);
  void close();  // at once; the server forgets it

  bool is_stream() const { return state_ == State::streaming; }
  bool is_idle() const { return state_ == State::reading && input_.empty(); }
  Clock::time_point since() const { return since_; }
  // Of a stream: when a value that waits may be sent.
  std::optional<Clock::time_point> due() const { return due_; }

  void send(std::string_view message) override;
  std::size_t unsent() const override { return output_.unsent(); }
  void wake() override;

 private:
  enum class State { reading, answering, streaming, draining, closed };

  void pump();
  void take_request();
  bool take_head();
  void answer();
  tl::expected<void, HttpError> judge() const;
  bool admit(Peer::Http right);
  void begin_rpc();
  void go_on_with_rpc();
  void begin_stream();
  std::optional<HttpError> subscribe_all();
  void give_file();
  void reply(const HttpReply& reply);
  void refuse(const HttpError& error, std::string fields = "");
  void request_ends(bool keep_alive);
  void send_events();
  void send_stream();
  void flush();
  void wait();
  void wait_readable();
  void wait_writable();
  void receive();
  void drain();
  void drop(const std::string& why);

  HttpServerCore& server_;
  asio::posix::stream_descriptor socket_;
  const Peer peer_;
  State state_ = State::reading;
  std::string input_;        // from the beginning of a request
  std::size_t scanned_ = 0;  // of it
  std::optional<HttpHead> head_;
  std::size_t body_at_ = 0;  // in input_, once the head is read
  std::shared_ptr<Session> session_;
  std::optional<std::string> reply_;  // of a call, not yet sent
  bool calling_ = false;              // of a batch there is more to call
  std::vector<std::string> events_;   // topics of a stream that are events
  std::uint64_t seen_ = 0;            // id of the newest event that a stream has
  Outbox output_;
  bool reading_ = false, writing_ = false, readable_ = false, has_turn_ = false;
  bool input_ended_ = false, shut_down_ = false;
  Clock::time_point since_ = Clock::now();  // of what goes on: idle, a head, a body, draining
  Clock::time_point sent_ = since_;         // on a stream
  std::optional<Clock::time_point> due_, stalled_since_;
};

}  // namespace mdof::rpc
