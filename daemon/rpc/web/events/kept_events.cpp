#include "daemon/rpc/web/events/kept_events.h"

#include <algorithm>
#include <charconv>

namespace mdof::rpc {
namespace {

std::uint64_t first_id(std::chrono::system_clock::time_point start) {
  using std::chrono::microseconds;
  const auto us = std::chrono::duration_cast<microseconds>(start.time_since_epoch()).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(us, 1));
}

}  // namespace

KeptEvents::KeptEvents(std::chrono::system_clock::time_point start, Limits limits)
    : limits_(limits), base_(first_id(start)), next_(base_ + 1) {}

void KeptEvents::add(std::string_view topic, std::string_view json) {
  events_.push_back({next_++, std::string(topic), std::string(json)});
  for (char& c : events_.back().json)
    if (c == '\n' || c == '\r') c = ' ';
  bytes_ += topic.size() + json.size();
  while (events_.size() > limits_.events || (bytes_ > limits_.bytes && events_.size() > 1)) {
    bytes_ -= events_.front().topic.size() + events_.front().json.size();
    events_.pop_front();
  }
}

KeptEvents::Resumed KeptEvents::resume(std::string_view id) const {
  if (id.empty()) return {.after = last_id()};
  std::uint64_t seen = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), seen);
  const bool ours =
      error == std::errc{} && end == id.data() + id.size() && seen >= base_ && seen <= last_id();
  if (!ours) return {.after = last_id(), .lost = true};
  const std::uint64_t lost = next(seen).lost;
  return {.after = seen + lost, .lost = lost > 0, .count = lost};
}

KeptEvents::Next KeptEvents::next(std::uint64_t after) const {
  const std::uint64_t first = next_ - events_.size();
  if (after + 1 < first) return {nullptr, first - 1 - after};
  const auto at = static_cast<std::size_t>(after + 1 - first);
  return {at < events_.size() ? &events_[at] : nullptr, 0};
}

}  // namespace mdof::rpc
