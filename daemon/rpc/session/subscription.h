// The subscription of one client to one topic, with the pending messages and the times at which
// they are due. Private header.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/topic.h"

namespace mdof::rpc {

// The class reads no clock: the caller states the time.
class Subscription {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Value = std::shared_ptr<const std::string>;  // JSON text; all subscriptions share it

  // The topic must outlive the subscription.
  Subscription(const Topic& topic, std::chrono::milliseconds interval, std::size_t max_queued);

  const Topic& topic() const { return topic_; }
  std::chrono::milliseconds interval() const { return interval_; }
  bool awaits_first() const;
  void set_interval(std::chrono::milliseconds interval) { interval_ = interval; }

  // Adds a value or an event. `of` is its source, for example the axis "X".
  // - A value replaces the pending value of the same source. Each source has its own interval;
  // otherwise values of several sources that arrive together would always replace each other.
  // - An event is added to a queue. If the queue is full, the oldest event is dropped.
  void offer(Value value, Time now, std::string_view of = "");
  void miss() { ++missed_; }  // counts a value that is too large to be sent
  // The earliest time at which the next message may be sent; nullopt: no message is pending. A
  // value that was offered long before this time would be old when it is sent. Its time is
  // therefore one interval later, so that a newer value can replace it.
  std::optional<Time> due() const;
  // Appends the due message to `out`.
  void take(Time now, std::string& out);

 private:
  const Topic& topic_;
  std::chrono::milliseconds interval_;
  std::size_t max_queued_;
  struct Line {  // the pending messages of one source
    std::string of;
    std::deque<Value> waiting = {};
    Time next{}, offered{};
  };
  std::optional<Time> due_of(const Line& line) const;

  std::vector<Line> lines_;
  std::uint64_t missed_ = 0;
};

}  // namespace mdof::rpc
