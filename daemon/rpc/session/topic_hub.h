// Who subscribed to what. Private header.
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
  // Something waits to be sent; comes from within publish().
  virtual void wake() = 0;
};

// Thread-bound: the loop.
class TopicHub {
 public:
  explicit TopicHub(const ServerOptions& options) : options_(options) {}

  void add(Topic topic);                                           // a name twice is a bug
  const Topic* topic(std::string_view name) const;                 // none: nullptr
  bool fits(std::string_view topic, std::string_view json) const;  // into a message
  std::optional<std::chrono::milliseconds> wanted_every(std::string_view topic) const;
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

// Gives `send` what is due and has room, a message a call: below `max_bytes` in all another one is
// begun. Gives the time of the next message that waits for nothing but time.
std::optional<Subscription::Time> take_due(Subscriber& who, Subscription::Time now,
                                           std::size_t max_bytes,
                                           const std::function<void(std::string_view)>& send);

}  // namespace mdof::rpc
