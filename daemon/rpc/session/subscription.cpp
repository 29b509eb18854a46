#include "daemon/rpc/session/subscription.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

// Age at which a value is old. If a new value is made every 20 ms, no pending value becomes old.
constexpr std::chrono::milliseconds kOld{50};

}  // namespace

Subscription::Subscription(const Topic& topic, std::chrono::milliseconds interval,
                           std::size_t max_queued)
    : topic_(topic), interval_(interval), max_queued_(topic.event ? max_queued : 1) {}

bool Subscription::awaits_first() const {
  return lines_.empty() || std::any_of(lines_.begin(), lines_.end(),
                                       [](const Line& line) { return line.next == Time{}; });
}

void Subscription::offer(Value value, Time now, std::string_view of) {
  auto line = std::find_if(lines_.begin(), lines_.end(), [&](const Line& l) { return l.of == of; });
  if (line == lines_.end()) line = lines_.insert(line, Line{std::string(of)});
  line->offered = now;
  line->waiting.push_back(std::move(value));
  if (line->waiting.size() <= max_queued_) return;
  line->waiting.pop_front();
  ++missed_;
}

std::optional<Subscription::Time> Subscription::due_of(const Line& line) const {
  if (line.waiting.empty()) return std::nullopt;
  if (topic_.event) return Time{};
  return line.next - line.offered > kOld ? line.next + interval_ : line.next;
}

std::optional<Subscription::Time> Subscription::due() const {
  std::optional<Time> first;
  for (const Line& line : lines_)
    if (const auto at = due_of(line)) first = std::min(first.value_or(*at), *at);
  return first;
}

void Subscription::take(Time now, std::string& out) {
  const auto line =
      std::find_if(lines_.begin(), lines_.end(),
                   [this, first = due()](const Line& l) { return first && due_of(l) == first; });
  assert(line != lines_.end());
  append_notification(
      out, topic_.name,
      R"({"missed":)" + std::to_string(missed_) + R"(,"value":)" + *line->waiting.front() + '}');
  line->waiting.pop_front();
  missed_ = 0;
  line->next = now + interval_;
}

}  // namespace mdof::rpc
