// The latest events of all topics, for browsers that come back and say what they saw last. Private
// header.
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

// Ids rise by 1, and from one life of mdofd to the next: they begin at its start in microseconds.
// Below 2^53, so that a page may take one as a number.
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

  // The oldest go when there are too many. A line end in `json` becomes a space.
  void add(std::string_view topic, std::string_view json);
  std::uint64_t last_id() const { return next_ - 1; }
  std::size_t size() const { return events_.size(); }

  // Where a client goes on that saw `id` last, and how many it has lost. What another life of mdofd
  // had after it nobody knows.
  struct Resumed {
    std::uint64_t after;
    bool lost = false;
    std::optional<std::uint64_t> count = {};
  };
  Resumed resume(std::string_view id) const;

  // The first event behind `after`, of any topic, unless `lost` of them are gone.
  struct Next {
    const Event* event = nullptr;  // none: that was the last
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
