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

#include "daemon/rpc/net/client_socket.h"
#include "daemon/rpc/web/http_head.h"
#include "daemon/rpc/web/http_reply.h"

namespace mdof::rpc {

struct HttpServerCore;

// Thread-bound: the loop. A request has a session of its own, and so has a stream. Nothing more is
// read until a request is answered and the answer is taken; what waits for a stream stays with
// those who share it (KeptEvents, Subscription), so that a slow browser costs no memory.
class HttpConnection final : public ClientSocket {
 public:
  HttpConnection(HttpServerCore& server, int socket);  // takes it; connected and non-blocking

  void start() { wait_readable(); }
  void turn_away();
  void check_times(Clock::time_point now);

  bool is_stream() const { return is(State::streaming); }
  bool is_idle() const { return is(State::reading) && input_.empty(); }
  Clock::time_point since() const { return since_; }
  // Of a stream: when a value that waits may be sent.
  std::optional<Clock::time_point> due() const { return due_; }

  void send(std::string_view message) override;

 private:
  enum class State { reading, answering, streaming, draining };

  bool is(State state) const { return !closed_ && state_ == state; }
  void ask_for_turn() override;
  void forget() override;
  void receive() override;
  void pump() override;
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
  void wait();
  void drain();
  void drop(const std::string& why);

  HttpServerCore& server_;
  const Peer peer_;
  State state_ = State::reading;
  std::string input_;        // from the beginning of a request
  std::size_t scanned_ = 0;  // of it
  std::optional<HttpHead> head_;
  std::size_t body_at_ = 0;                 // in input_, once the head is read
  std::optional<std::string> reply_;        // of a call, not yet sent
  bool calling_ = false;                    // of a batch there is more to call
  std::vector<std::string> events_;         // topics of a stream that are events
  std::uint64_t seen_ = 0;                  // id of the newest event that a stream has
  Clock::time_point since_ = Clock::now();  // of what goes on: idle, a head, a body, draining
  Clock::time_point sent_ = since_;         // on a stream
  std::optional<Clock::time_point> due_;
};

}  // namespace mdof::rpc
