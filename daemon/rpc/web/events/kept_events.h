// Keeps the latest events of all topics. A browser that reconnects states the id of its last event
// and receives the later events. Private header.
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

// The id of an event is the id of the event before it + 1. The first id is the start time of mdofd
// in microseconds, plus 1; ids therefore also increase when mdofd restarts. The ids are below 2^53,
// because JavaScript represents larger integers inexactly.
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

  // The position from which a client continues if its last event has the id `id`. `count`: number
  // of lost events; nullopt if this number is unknown, because `id` is from an earlier start of
  // mdofd.
  struct Resumed {
    std::uint64_t after;
    bool lost = false;
    std::optional<std::uint64_t> count = {};
  };
  Resumed resume(std::string_view id) const;

  // The first event of any topic whose id is larger than `after`. If some of these events are no
  // longer kept, `lost` is their number and `event` is nullptr.
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
