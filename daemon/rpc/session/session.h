// One client, whatever carries its messages: what it may do, which of its calls are open, what it
// has subscribed to. Private header.
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

// Carries the messages of one session. Its calls come from the session, on the loop.
class Transport {
 public:
  virtual ~Transport() = default;
  // Takes one message; what marks its end on the wire is the transport's to add.
  virtual void send(std::string_view message) = 0;
  virtual std::size_t unsent() const = 0;  // bytes that the client has not taken yet
  // Asks for a turn: there is something to send, or room for a request again. Comes from within
  // other work, so that the turn must be a later one.
  virtual void wake() = 0;
};

// What the sessions of a daemon share; outlives them.
struct SessionParts {
  Dispatcher& dispatcher;
  TopicHub& topics;
  const ServerOptions& options;
};

// Thread-bound: the loop. The transport releases it before it ends itself.
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

  // The rule behind all bounds: a request begins only when its largest reply has room.
  bool has_room() const;
  // Takes one message, followed by Dispatcher::kPadding readable bytes; only with has_room() and
  // before end(). Appends the reply to `out` where it is known at once; a later one goes to
  // Transport::send. False: it is a batch that was not done by `until`; the same message has to
  // be given again, before any other.
  bool handle(std::string_view message, std::string& out,
              Clock::time_point until = Clock::time_point::max());
  // Sends the notifications that are due, up to about a reply's bytes. Gives when the next is.
  std::optional<Clock::time_point> send_due(Clock::time_point now);

  bool has_subscriptions() const { return !subscriptions.empty(); }
  bool awaits_nothing() const;                // no open call, no subscription
  bool is_idle(Clock::time_point now) const;  // for longer than the limit

  // Sends the reason, and ends.
  void refuse(std::string_view why);
  void end_idle();
  // No more messages: subscriptions end, and late replies are thrown away.
  void end();

  const Peer& peer() const { return peer_; }
  std::string name() const;  // for the log

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
  std::size_t open_exchanges_ = 0;  // messages whose reply comes later
  Clock::time_point active_;        // a request came, or was answered
};

}  // namespace mdof::rpc
