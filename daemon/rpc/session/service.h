// Methods, topics, limits and sessions of all clients, independent of the transport.
// daemon/rpc/README.md describes the protocol.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/method_table.h"
#include "daemon/rpc/server_options.h"
#include "daemon/rpc/session/session.h"
#include "daemon/rpc/topic.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Thread-bound: use the service on the thread of the loop, or while the loop does not run. The
// table must exist longer than the service, and the service longer than all transports.
class Service {
 public:
  // `loop` sends replies that become complete after their handler has returned.
  Service(std::shared_ptr<Executor> loop, const MethodTable& table, ServerOptions options = {});
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  // Returns a session for a connected client. Error: there are too many clients; the message states
  // the limit. The session counts as a client until the transport releases it, when the client
  // disconnects.
  Result<std::shared_ptr<Session>> admit(Peer peer, Transport& transport);
  std::size_t session_count() const;
  std::vector<std::string> clients() const;  // names of the clients (Session::name())

  void add_topic(Topic topic);
  // nullptr if the topic does not exist.
  const Topic* topic(std::string_view name) const { return topics_.topic(name); }
  // From now on, calls `event_callback` with each event before the subscribers receive the event,
  // also if there is no subscriber. The HTTP server uses these calls to keep events for browsers
  // that reconnect. An empty function ends the calls.
  using Hear = std::function<void(std::string_view topic, std::string_view json)>;
  void on_event(Hear event_callback) { event_listener_ = std::move(event_callback); }
  // The interval at which the program should make values of this topic:
  // - all subscribers have the same interval: this interval
  // - the intervals differ, or a subscriber waits for its first value: min_interval of the topic
  // - no subscribers: nullopt
  std::optional<std::chrono::milliseconds> wanted_interval(std::string_view topic) const;
  // `json` is one JSON value. The call is short, because all subscribers share the value, and a
  // later turn of the loop sends it. Errors: the topic is unknown; the value is too large for a
  // message (the next message then counts it in "missed"). `of`: the source of the value, for
  // example the axis.
  Status publish(std::string_view topic, std::string json, std::string_view of = "");

  const ServerOptions& options() const { return options_; }
  void log(const std::string& line) const;

 private:
  enum class Place { ordinary, kept, http };
  struct Holder {
    std::weak_ptr<Session> session;
    Place place;
  };
  Result<Place> place_for(const Peer& peer) const;

  const ServerOptions options_;
  Dispatcher dispatcher_;
  TopicHub topics_;
  std::vector<Holder> holders_;
  Hear event_listener_;
  std::string last_refusal_;  // why the last rejected client was rejected, as logged
};

}  // namespace mdof::rpc
