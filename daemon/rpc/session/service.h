// Data that all clients share, independent of their transport: methods, topics, limits and
// connections. README.md describes the protocol.
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

// Thread-bound: call it on the loop's thread (from other threads through the loop), or while the
// loop does not run. The table must outlive it, and it must outlive all transports.
class Service {
 public:
  // `loop` runs the follow-up work of late replies.
  Service(std::shared_ptr<Executor> loop, const MethodTable& table, ServerOptions options = {});
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  // Returns a session for a connected client, or the reason why there is no free place. The session
  // keeps its place until it is released: the transport releases it when the client disconnects.
  Result<std::shared_ptr<Session>> admit(Peer peer, Transport& transport);
  std::size_t session_count() const;
  std::vector<std::string> clients() const;  // names of the clients (Session::name())

  void add_topic(Topic topic);
  // nullptr if the topic does not exist.
  const Topic* topic(std::string_view name) const { return topics_.topic(name); }
  // Calls `hear` with each event, with or without subscribers, before they get it. It serves to
  // keep events for browsers that reconnect. An empty function ends this.
  using Hear = std::function<void(std::string_view topic, std::string_view json)>;
  void on_event(Hear hear) { event_listener_ = std::move(hear); }
  // The interval at which values should be made, so that no value is made in vain and all
  // subscribers get new ones: the common interval of the subscribers, or the shortest interval of
  // the topic if a subscriber waits for its first value or the intervals differ. nullopt: no
  // subscribers.
  std::optional<std::chrono::milliseconds> wanted_interval(std::string_view topic) const;
  // `json` is one JSON value. Cheap: all waiting subscribers share the value, and it is sent in a
  // later turn of the loop. Errors: unknown topic; value too large for a reply (subscribers then
  // see it in "missed"). `of`: the source of the value (topic.h).
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
  std::string last_refusal_;  // the last logged reason for which a client was turned away
};

}  // namespace mdof::rpc
