// All topics and their subscribers. Private header.
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/server_options.h"
#include "daemon/rpc/session/subscription.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// The subscriptions of one client.
struct Subscriber {
  std::list<Subscription> subscriptions;

  virtual ~Subscriber() = default;
  // Called during publish() when a message is pending.
  virtual void wake() = 0;
};

// Thread-bound to the event loop.
class TopicHub {
 public:
  explicit TopicHub(const ServerOptions& options) : options_(options) {}

  void add(Topic topic);  // a second topic with the same name is a programming error
  const Topic* topic(std::string_view name) const;  // nullptr if unknown
  // Whether `json` fits into a message.
  bool fits(std::string_view topic, std::string_view json) const;
  std::optional<std::chrono::milliseconds> wanted_interval(std::string_view topic) const;
  Status publish(std::string_view topic, std::string json, std::string_view of = "");

  Status subscribe(Subscriber& who, std::string_view topic, std::chrono::milliseconds interval);
  Status unsubscribe(Subscriber& who, std::string_view topic);
  void forget(Subscriber& who);

 private:
  using Entry = std::list<Subscription>::iterator;
  struct Row {
    Topic topic;
    std::vector<std::pair<Subscriber*, Entry>> subscribers;
  };
  Result<Row*> row(std::string_view topic);
  static void drop(Row& row, Subscriber& who);

  const ServerOptions& options_;
  std::map<std::string, Row, std::less<>> rows_;
};

// Calls send() with each due message, until at least `max_bytes` were sent. Returns the earliest
// time at which another pending message is due.
std::optional<Subscription::Time> take_due(Subscriber& who, Subscription::Time now,
                                           std::size_t max_bytes,
                                           const std::function<void(std::string_view)>& send);

}  // namespace mdof::rpc
