// What clients can subscribe to.
#pragma once

#include <chrono>
#include <string>

namespace mdof::rpc {

// A message of a topic is a notification: its method is the topic's name, its params are
// {"missed": n, "value": ...}. `missed` counts what was not sent since the message before.
struct Topic {
  std::string name;
  // false: a value, of which only the newest is worth sending, of each axis; a slow client gets
  // fewer of them.
  // true: an event, each worth sending; they queue for a slow client up to max_queued_events.
  bool event = false;
  std::chrono::milliseconds min_interval{20};  // between two messages to a client; values only
};

}  // namespace mdof::rpc
