// What all clients share, whatever carries their messages: methods, topics, limits and places.
// README.md has the rules of the wire.
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

// Thread-bound: every call on the loop's thread, or while the loop does not run; from elsewhere
// through the loop. Outlived by the table, outlives every transport.
class Service {
 public:
  // `loop` runs what comes of late replies.
  Service(std::shared_ptr<Executor> loop, const MethodTable& table, ServerOptions options = {});
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  // A session for a client that has connected, or why there is no place for it. It has its place
  // until nobody holds it any more: the transport releases it when the client has gone.
  Result<std::shared_ptr<Session>> admit(Peer peer, Transport& transport);
  std::size_t session_count() const;
  std::vector<std::string> clients() const;  // their names (Session::name())

  void add_topic(Topic topic);
  // Is there such a topic?
  const Topic* topic(std::string_view name) const { return topics_.topic(name); }
  // Calls `hear` with each event, subscribed to or not, before subscribers get it: for what keeps
  // events for those who come back. Nothing: no more.
  using Hear = std::function<void(std::string_view topic, std::string_view json)>;
  void on_event(Hear hear) { hear_ = std::move(hear); }
  // How often values are to be made, so that none is made in vain and each subscriber gets a fresh
  // one: at their interval, and as often as the topic allows while one awaits his first or they
  // have asked for different ones. Nothing: nobody has subscribed.
  std::optional<std::chrono::milliseconds> wanted_every(std::string_view topic) const;
  // `json` is one JSON value. Cheap: the value is shared by those who wait for it, and sent in a
  // later turn of the loop. Errors: no such topic, too large for a reply (subscribers then learn
  // in "missed"). `of`: what it is a value of (topic.h).
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
  Hear hear_;
  std::string last_refusal_;  // the log, why a client was turned away
};

}  // namespace mdof::rpc
