// One client's subscription to one topic: pending messages and their times. Private header.
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

// Pure: the caller gives the time.
class Subscription {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Value = std::shared_ptr<const std::string>;  // JSON, shared by all waiting subscriptions

  // The topic must outlive the subscription.
  Subscription(const Topic& topic, std::chrono::milliseconds interval, std::size_t max_queued);

  const Topic& topic() const { return topic_; }
  std::chrono::milliseconds interval() const { return interval_; }
  bool awaits_first() const;
  void set_interval(std::chrono::milliseconds interval) { interval_ = interval; }

  // A value replaces the pending value of the same source. Each `of` ("X", an axis) has its own
  // intervals, because values that arrive together would otherwise replace each other for ever. An
  // event is queued; if the queue is full, the oldest event is dropped.
  void offer(Value value, Time now, std::string_view of = "");
  void miss() { ++missed_; }  // counts a value that cannot be sent
  // Earliest time of the next message; nullopt: none is pending. A value that would be old at that
  // time is delayed by one more interval, so that a newer value can replace it.
  std::optional<Time> due() const;
  // Appends this message.
  void take(Time now, std::string& out);

 private:
  const Topic& topic_;
  std::chrono::milliseconds interval_;
  std::size_t max_queued_;
  struct Line {  // messages of one source
    std::string of;
    std::deque<Value> waiting = {};
    Time next{}, offered{};
  };
  std::optional<Time> due_of(const Line& line) const;

  std::vector<Line> lines_;
  std::uint64_t missed_ = 0;
};

}  // namespace mdof::rpc
