#include "daemon/rpc/web/events/event_query.h"

#include <charconv>
#include <optional>

#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

constexpr std::int64_t kLongest_ms = 3'600'000;
constexpr std::size_t kMostTopics = 32;

tl::unexpected<HttpError> bad_query(std::string text) {
  return tl::unexpected(HttpError{400, std::move(text)});
}

std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    unsigned code = 0;
    const auto digits = text.substr(i + 1, 2);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() != 2 || error != std::errc{} || end != digits.data() + 2) return std::nullopt;
    out += static_cast<char>(code);
    i += 2;
  }
  return out;
}

// Returns the text before the next `separator` and removes both from `rest`.
std::string_view cut(std::string_view& rest, char separator) {
  const auto at = rest.find(separator);
  const auto part = rest.substr(0, at);
  rest.remove_prefix(at == rest.npos ? rest.size() : at + 1);
  return part;
}

tl::expected<void, HttpError> take_topics(std::string_view list, EventQuery& out) {
  while (!list.empty()) {
    if (const auto topic = cut(list, ','); !topic.empty()) out.topics.emplace_back(topic);
    if (out.topics.size() > kMostTopics)
      return bad_query("topics: too many topics; the limit is " + std::to_string(kMostTopics));
  }
  return {};
}

tl::expected<void, HttpError> take_interval(std::string_view text, EventQuery& out) {
  std::int64_t ms = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
  if (error != std::errc{} || end != text.data() + text.size() || ms < 1 || ms > kLongest_ms)
    return bad_query("interval_ms: must be a whole number from 1 to " +
                     std::to_string(kLongest_ms));
  out.interval = std::chrono::milliseconds(ms);
  return {};
}

}  // namespace

tl::expected<EventQuery, HttpError> read_event_query(std::string_view query) {
  EventQuery out;
  while (!query.empty()) {
    std::string_view value = cut(query, '&');
    const auto key = cut(value, '=');
    const auto text = decoded(value);
    if (!text)
      return bad_query("the part of the address after \"?\" is not correctly percent-encoded");
    if (key == "topics") {
      MDOF_CHECK(take_topics(*text, out));
    } else if (key == "interval_ms") {
      MDOF_CHECK(take_interval(*text, out));
    } else {
      return bad_query("unknown parameter " + in_quotes(key) +
                       "; the parameters are topics and interval_ms");
    }
  }
  if (out.topics.empty())
    return bad_query(
        "topics: is missing; use, for example, "
        "/events?topics=live.update,run.event&interval_ms=100");
  return out;
}

}  // namespace mdof::rpc
