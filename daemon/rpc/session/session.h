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

// Transmits the messages of one session. The session calls it on the event loop.
class Transport {
 public:
  virtual ~Transport() = default;
  // Sends one message; the transport adds the line end or other framing.
  virtual void send(std::string_view message) = 0;
  virtual std::size_t unsent() const = 0;  // bytes that the client has not yet taken
  // Asks for a turn, because there is something to send or space for a request again. It is called
  // during other work, so the turn must come later.
  virtual void wake() = 0;
};

// Objects that all sessions of a daemon share; they outlive the sessions.
struct SessionParts {
  Dispatcher& dispatcher;
  TopicHub& topics;
  const ServerOptions& options;
};

// Thread-bound: the event loop. The transport releases it before its own end.
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

  // The basis of all limits: a request only begins if its largest reply has space.
  bool has_room() const;
  // Handles one message, followed by Dispatcher::kPadding readable bytes. Call it only with
  // has_room() and before end(). Appends the reply to `out` if it is known at once; a later reply
  // goes to Transport::send. False: a batch was not finished by `until`; call it again with the
  // same message, before any other.
  bool handle(std::string_view message, std::string& out,
              Clock::time_point until = Clock::time_point::max());
  // Sends the due notifications, up to about the size of a reply. Returns the time of the next one.
  std::optional<Clock::time_point> send_due(Clock::time_point now);

  bool has_subscriptions() const { return !subscriptions.empty(); }
  bool has_nothing_pending() const;           // no open calls, no subscriptions
  bool is_idle(Clock::time_point now) const;  // whether it was idle for longer than the limit

  // Sends the reason and ends the session.
  void refuse(std::string_view why);
  void end_idle();
  // No further messages: subscriptions end, and late replies are dropped.
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
  std::size_t open_exchanges_ = 0;  // messages with a late reply
  Clock::time_point active_;        // time of the last request or answer
};

}  // namespace mdof::rpc
