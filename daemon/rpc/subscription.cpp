#include "daemon/rpc/subscription.h"

#include <cassert>
#include <utility>

#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

constexpr std::chrono::milliseconds kOld{50};  // none is where they are made every 20 ms

}  // namespace

Subscription::Subscription(const Topic& topic, std::chrono::milliseconds interval,
                           std::size_t max_queued)
    : topic_(topic), interval_(interval), max_queued_(topic.event ? max_queued : 1) {}

void Subscription::offer(Value value, Time now) {
  offered_ = now;
  waiting_.push_back(std::move(value));
  if (waiting_.size() <= max_queued_) return;
  waiting_.pop_front();
  ++missed_;
}

std::optional<Subscription::Time> Subscription::due() const {
  if (waiting_.empty()) return std::nullopt;
  if (topic_.event) return Time{};
  return next_ - offered_ > kOld ? next_ + interval_ : next_;
}

void Subscription::take(Time now, std::string& out) {
  assert(!waiting_.empty());
  append_notification(
      out, topic_.name,
      R"({"missed":)" + std::to_string(missed_) + R"(,"value":)" + *waiting_.front() + '}');
  out += '\n';
  waiting_.pop_front();
  missed_ = 0;
  next_ = now + interval_;
}

}  // namespace mdof::rpc
