// One client, independent of its transport: its permissions, open calls and subscriptions. Private
// header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/rpc/caller.h"
#include "daemon/rpc/server_options.h"
#include "daemon/rpc/session/dispatcher.h"
#include "daemon/rpc/session/exchange.h"
#include "daemon/rpc/session/peer.h"
#include "daemon/rpc/session/topic_hub.h"

namespace mdof::rpc {

// Transmits the messages of one session. The session calls these functions on the event loop.
class Transport {
 public:
  virtual ~Transport() = default;
  // Sends one message. The transport adds the separator of messages, for example a line end.
  virtual void send(std::string_view message) = 0;
  virtual std::size_t unsent() const = 0;  // bytes that were not sent yet
  // Asks for a turn, because there is something to send, or because the reply to a request has
  // space again. The function must not begin the turn itself, because wake() is called during other
  // work.
  virtual void wake() = 0;
};

// Objects that all sessions of a daemon share. They exist longer than the sessions.
struct SessionParts {
  Dispatcher& dispatcher;
  TopicHub& topics;
  const ServerOptions& options;
};

// Thread-bound to the event loop. The transport releases the session before the transport is
// destroyed.
class Session final : public Caller,
                      public ReplySink,
                      public Subscriber,
                      public std::enable_shared_from_this<Session> {
 public:
  using Clock = std::chrono::steady_clock;

  Session(const SessionParts& parts, Peer peer, Transport& transport);
  ~Session() override;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Whether the largest possible reply has space in the unsent output. A request only begins if
  // this is true; all limits depend on this rule.
  bool has_room() const;
  // Handles one message. Dispatcher::kPadding readable bytes must follow the message. Call handle()
  // only if has_room() is true, and before end(). If the reply is known at once, appends it to
  // `out`; otherwise sends it later with Transport::send(). Returns false if a batch was not
  // finished at the time `until`; then call handle() again with the same message before any other
  // message.
  bool handle(std::string_view message, std::string& out,
              Clock::time_point until = Clock::time_point::max());
  // Sends the due notifications, at most about max_reply_bytes. Returns the time of the next
  // notification.
  std::optional<Clock::time_point> send_due(Clock::time_point now);

  bool has_subscriptions() const { return !subscriptions.empty(); }
  bool has_nothing_pending() const;  // no open calls, no subscriptions
  // Whether the client was idle for longer than idle_timeout.
  bool is_idle(Clock::time_point now) const;

  // Sends the reason and ends the session.
  void refuse(std::string_view why);
  void end_idle();
  // Ends the session: its subscriptions end, and replies that come later are dropped.
  void end();

  const Peer& peer() const { return peer_; }
  std::string name() const;  // name for the log

  std::optional<Credentials> credentials() const override { return peer_.credentials; }
  bool may_write() const override;
  bool over_http() const override { return peer_.http != Peer::Http::no; }
  bool in_group(gid_t group) const override { return peer_.is_member(group); }
  std::vector<gid_t> further_groups() const override { return peer_.further_groups; }
  Status subscribe(std::string_view topic, std::chrono::milliseconds interval) override;
  Status unsubscribe(std::string_view topic) override;
  void finish(std::string_view reply) override;
  void wake() override;

 private:
  void end_with(int code, std::string_view message, std::string_view why);

  SessionParts parts_;
  const Peer peer_;
  Transport& transport_;
  bool ended_ = false;
  BegunBatch batch_;
  std::size_t open_exchanges_ = 0;  // number of messages whose reply comes later
  Clock::time_point active_;        // time of the last request or answer
};

}  // namespace mdof::rpc
