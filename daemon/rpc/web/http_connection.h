// One connection of a browser, which handles requests one after the other, or sends a stream of
// events. The limits of the connection protect the other clients. Private header.
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

// Thread-bound to the event loop. Each request and each stream has its own session. The connection
// reads the next request after the client has received the answer to the previous request. Pending
// messages of a stream are in KeptEvents and Subscription, which limit them. A slow browser
// therefore needs little memory.
class HttpConnection final : public ClientSocket {
 public:
  // Takes ownership of `socket`, which must be connected and non-blocking.
  HttpConnection(HttpServerCore& server, int socket);

  void start() { wait_readable(); }
  void reject_connection();
  void check_times(Clock::time_point now);

  bool is_stream() const { return is(State::streaming); }
  bool is_idle() const { return is(State::reading) && input_.empty(); }
  Clock::time_point since() const { return since_; }
  // For a stream: the time at which the next pending value may be sent.
  std::optional<Clock::time_point> due() const { return due_; }

  void send(std::string_view message) override;

 private:
  enum class State { reading, answering, streaming, draining };

  bool is(State state) const { return !closed_ && state_ == state; }
  void request_turn() override;
  void forget() override;
  void receive() override;
  void pump() override;
  void take_request();
  bool take_head();
  void answer();
  tl::expected<void, HttpError> judge() const;
  bool admit(Peer::Http right);
  void begin_rpc();
  void continue_rpc();
  void begin_stream();
  std::optional<HttpError> subscribe_all();
  void send_file();
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
  std::string input_;        // received bytes, from the beginning of the present request
  std::size_t scanned_ = 0;  // number of bytes in input_ that were searched for the end of the head
  std::optional<HttpHead> head_;
  std::size_t body_at_ = 0;           // offset of the body in input_; valid after the head was read
  std::optional<std::string> reply_;  // reply to a call, not yet sent
  bool calling_ = false;              // a batch contains requests that have not been called yet
  std::vector<std::string> events_;   // topics of a stream that have events
  std::uint64_t seen_ = 0;            // id of the newest event that was sent on the stream
  // Beginning of the present phase: idle, head, body, draining.
  Clock::time_point since_ = Clock::now();
  Clock::time_point sent_ = since_;  // last output on a stream
  std::optional<Clock::time_point> due_;
};

}  // namespace mdof::rpc
