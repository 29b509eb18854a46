// The latest events of all topics, for browsers that reconnect and state the last event that they
// saw. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::rpc {

// Ids increase by 1. They begin at the start time of mdofd in microseconds, so that they also
// increase over restarts. They are below 2^53, so that JavaScript can use them as numbers.
class KeptEvents {
 public:
  struct Limits {
    std::size_t events, bytes;
  };
  struct Event {
    std::uint64_t id;
    std::string topic, json;
  };

  KeptEvents(std::chrono::system_clock::time_point start, Limits limits);

  // Drops the oldest events if there are too many. A line end in `json` becomes a space.
  void add(std::string_view topic, std::string_view json);
  std::uint64_t last_id() const { return next_ - 1; }
  std::size_t size() const { return events_.size(); }

  // The position at which a client with the last event `id` continues. `count` is the number of
  // lost events; nullopt if `id` is from an earlier start of mdofd, because the number is then
  // unknown.
  struct Resumed {
    std::uint64_t after;
    bool lost = false;
    std::optional<std::uint64_t> count = {};
  };
  Resumed resume(std::string_view id) const;

  // The first event after `after`, of any topic. If `lost` events after it are no longer kept,
  // there is no event in the result.
  struct Next {
    const Event* event = nullptr;  // nullptr: no further event, or lost > 0
    std::uint64_t lost = 0;
  };
  Next next(std::uint64_t after) const;

 private:
  Limits limits_;
  std::uint64_t base_, next_;
  std::deque<Event> events_;
  std::size_t bytes_ = 0;
};

}  // namespace mdof::rpc
