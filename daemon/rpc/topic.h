// Topics to which clients can subscribe.
#pragma once

#include <chrono>
#include <string>

namespace mdof::rpc {

// A message of a topic is a notification: its method is the topic's name, its params are {"missed":
// n, "value": ...}. `missed` counts the values that were not sent since the previous message.
struct Topic {
  std::string name;
  // false: a value, of which only the newest of each axis is sent; a slow client gets fewer values.
  // true: an event; events do not replace each other. For a slow client up to max_queued_events are
  // queued; then the oldest event is dropped.
  bool event = false;
  std::chrono::milliseconds min_interval{20};  // between two messages to a client; for values only
};

}  // namespace mdof::rpc
