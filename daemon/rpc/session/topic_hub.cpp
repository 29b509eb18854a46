#include "daemon/rpc/session/topic_hub.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

#include "daemon/rpc/message.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::rpc {
namespace {

// Length of a message without its value and the name of the topic.
constexpr std::size_t kEnvelopeBytes = 128;

}  // namespace

void TopicHub::add(Topic topic) {
  std::string name = topic.name;
  [[maybe_unused]] const bool added =
      rows_.emplace(std::move(name), Row{std::move(topic), {}}).second;
  assert(added && "a topic with this name already exists");
}

std::optional<std::chrono::milliseconds> TopicHub::wanted_interval(std::string_view topic) const {
  const auto found = rows_.find(topic);
  if (found == rows_.end() || found->second.subscribers.empty()) return std::nullopt;
  const auto& [wanted, subscribers] = found->second;
  const auto interval = subscribers.front().second->interval();
  const bool alike = std::all_of(subscribers.begin(), subscribers.end(), [&](const auto& entry) {
    return entry.second->interval() == interval && !entry.second->awaits_first();
  });
  return alike ? interval : wanted.min_interval;
}

Result<TopicHub::Row*> TopicHub::row(std::string_view topic) {
  if (const auto found = rows_.find(topic); found != rows_.end()) return &found->second;
  std::vector<std::string> names;
  std::string list;
  for (const auto& [name, row] : rows_) {
    names.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  const std::string near = topic.size() <= 64 ? nearest_candidate(topic, names) : "";
  return fail(ErrorCode::not_found, "no topic " + in_quotes(topic) +
                                        (near.empty() ? "; the topics are " + list
                                                      : "; did you mean " + in_quotes(near) + "?"));
}

const Topic* TopicHub::topic(std::string_view name) const {
  const auto found = rows_.find(name);
  return found == rows_.end() ? nullptr : &found->second.topic;
}

bool TopicHub::fits(std::string_view topic, std::string_view json) const {
  return json.size() + topic.size() + kEnvelopeBytes <= options_.max_reply_bytes;
}

Status TopicHub::publish(std::string_view topic, std::string json, std::string_view of) {
  MDOF_TRY(Row* const found, row(topic));
  if (!fits(topic, json)) {
    for (const auto& [who, entry] : found->subscribers) entry->miss();
    return fail(ErrorCode::usage, "topic " + in_quotes(topic) + ": a value of " +
                                      std::to_string(json.size()) +
                                      " bytes does not fit into a reply line (limit " +
                                      std::to_string(options_.max_reply_bytes) + " bytes)");
  }
  if (found->subscribers.empty()) return {};
  const auto value = std::make_shared<const std::string>(std::move(json));
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [who, entry] : found->subscribers) {
    entry->offer(value, now, of);
    who->wake();
  }
  return {};
}

Status TopicHub::subscribe(Subscriber& who, std::string_view topic,
                           std::chrono::milliseconds interval) {
  MDOF_TRY(Row* const found, row(topic));
  if (const auto least = found->topic.min_interval; !found->topic.event && interval < least)
    return fail(ErrorCode::usage, "interval_ms: " + std::to_string(interval.count()) +
                                      " is less than the minimum interval of the topic, " +
                                      std::to_string(least.count()));
  for (const auto& [other, entry] : found->subscribers)
    if (other == &who) return entry->set_interval(interval), Status{};
  if (who.subscriptions.size() >= options_.max_subscriptions)
    return fail(ErrorCode::usage, "this connection has " +
                                      std::to_string(options_.max_subscriptions) +
                                      " subscriptions (limit); unsubscribe from a topic first");
  who.subscriptions.emplace_back(found->topic, interval, options_.max_queued_events);
  found->subscribers.emplace_back(&who, std::prev(who.subscriptions.end()));
  return {};
}

void TopicHub::drop(Row& row, Subscriber& who) {
  std::erase_if(row.subscribers, [&](const auto& entry) { return entry.first == &who; });
}

Status TopicHub::unsubscribe(Subscriber& who, std::string_view topic) {
  MDOF_TRY(Row* const found, row(topic));
  drop(*found, who);
  who.subscriptions.remove_if([&](const Subscription& s) { return &s.topic() == &found->topic; });
  return {};
}

void TopicHub::forget(Subscriber& who) {
  if (who.subscriptions.empty()) return;
  for (auto& [name, row] : rows_) drop(row, who);
  who.subscriptions.clear();
}

std::optional<Subscription::Time> take_due(Subscriber& who, Subscription::Time now,
                                           std::size_t max_bytes,
                                           const std::function<void(std::string_view)>& send) {
  std::optional<Subscription::Time> next;
  auto& all = who.subscriptions;
  std::size_t sent = 0;
  std::string message;
  for (std::size_t i = all.size(); i > 0; --i) {
    Subscription& first = all.front();
    while (first.due() && *first.due() <= now) {
      if (sent >= max_bytes) return next;  // the next call begins with this subscription
      message.clear();
      first.take(now, message);
      send(message);
      sent += message.size();
    }
    if (const auto due = first.due()) next = std::min(next.value_or(*due), *due);
    all.splice(all.end(), all, all.begin());
  }
  return next;
}

}  // namespace mdof::rpc
