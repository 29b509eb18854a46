// Topics to which clients can subscribe.
#pragma once

#include <chrono>
#include <string>

namespace mdof::rpc {

// A message of a topic is a JSON-RPC notification. Its method is the name of the topic; its params
// are {"missed": n, "value": ...}. `missed` counts the values that were not sent since the previous
// message.
struct Topic {
  std::string name;
  // false: the topic has values. A newer value of an axis replaces an older value that has not been
  // sent, so a slow client receives fewer values. true: the topic has events, which do not replace
  // each other. If a slow client has max_queued_events pending events, the oldest event is dropped.
  bool event = false;
  // Shortest interval between two values to a client; not used for events.
  std::chrono::milliseconds min_interval{20};
};

}  // namespace mdof::rpc
