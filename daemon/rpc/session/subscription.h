// One client's subscription to one topic: what waits to be sent, and when it may. Private header.
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

// Pure: time comes in from outside.
class Subscription {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Value = std::shared_ptr<const std::string>;  // JSON; shared by all who wait for it

  // The topic must stay.
  Subscription(const Topic& topic, std::chrono::milliseconds interval, std::size_t max_queued);

  const Topic& topic() const { return topic_; }
  std::chrono::milliseconds interval() const { return interval_; }
  bool awaits_first() const;
  void set_interval(std::chrono::milliseconds interval) { interval_ = interval; }

  // A value takes the place of the one that waits, of the same thing: `of` ("X", an axis) has its
  // own pace, as two that come at the same time would for ever take each other's place. An event
  // queues, and the oldest goes when full.
  void offer(Value value, Time now, std::string_view of = "");
  void miss() { ++missed_; }  // one that cannot be sent
  // When the next message may be sent; nothing: none waits. A value that will have grown old by
  // then is held for another interval, for a newer one to take its place.
  std::optional<Time> due() const;
  // Appends that message.
  void take(Time now, std::string& out);

 private:
  const Topic& topic_;
  std::chrono::milliseconds interval_;
  std::size_t max_queued_;
  struct Line {  // of one thing
    std::string of;
    std::deque<Value> waiting = {};
    Time next{}, offered{};
  };
  std::optional<Time> due_of(const Line& line) const;

  std::vector<Line> lines_;
  std::uint64_t missed_ = 0;
};

}  // namespace mdof::rpc
