#include "drivers/capancdt/replies.h"

#include <charconv>
#include <cmath>

namespace mdof::drivers::capancdt {
namespace {

constexpr std::string_view kLineEnds = "\r\n";
constexpr std::string_view kRefusals[] = {"$UNKNOWN COMMAND", "$WRONG PARAMETER", "$WRONG PASSWORD",
                                          "$TIMEOUT"};

// Removes the next complete line from `text` and returns it.
std::optional<std::string_view> take_line(std::string_view& text) {
  const std::size_t end = text.find_first_of(kLineEnds);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line;
}

std::optional<Reply> reply_in(std::string_view command, std::string_view line) {
  for (const std::string_view refusal : kRefusals)
    if (line.find(refusal) != std::string_view::npos) return Reply{true, std::string(refusal)};
  const std::size_t at = line.rfind(command);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = line.substr(at + command.size());
  if (rest.ends_with("OK"))
    rest.remove_suffix(2);
  else if (command != "$VER" || rest.empty())
    return std::nullopt;  // the echo, or a truncated line
  return Reply{false, std::string(rest)};
}

std::string_view trim(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string after_colon(std::string_view line) {
  const std::size_t colon = line.find(':');
  return colon == std::string_view::npos ? "" : std::string(trim(line.substr(colon + 1)));
}

template <class T>
std::optional<T> parse_number(std::string_view text) {
  text = trim(text);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> um_per(std::string_view unit) {
  if (unit == "mm") return 1e3;
  if (unit == "nm") return 1e-3;
  for (const std::string_view um : {"um", "\xB5m", "\xC2\xB5m", "\xCE\xBCm"})
    if (unit == um) return 1.0;
  return std::nullopt;
}

}  // namespace

std::optional<Reply> find_reply(std::string_view command, std::string_view received) {
  while (const auto line = take_line(received))
    if (auto reply = reply_in(command, *line)) return reply;
  return std::nullopt;
}

Welcome parse_welcome(std::string_view received) {
  Welcome welcome;
  while (const auto line = take_line(received)) {
    if (line->empty()) continue;  // the empty text between CR and LF
    ++welcome.lines;
    if (welcome.lines == 2) welcome.name = after_colon(*line);
    if (welcome.lines == 3) welcome.serial = after_colon(*line);
  }
  return welcome;
}

std::string field(std::string_view fields, std::string_view key) {
  if (fields.starts_with(':')) fields.remove_prefix(1);
  while (!fields.empty()) {
    const std::string_view one = fields.substr(0, fields.find(','));
    if (one.starts_with(key)) return std::string(trim(one.substr(key.size())));
    fields.remove_prefix(one.size());
    if (!fields.empty()) fields.remove_prefix(1);
  }
  return "";
}

std::optional<std::vector<int>> parse_channel_list(std::string_view text) {
  std::vector<int> list;
  for (;;) {
    const std::string_view one = text.substr(0, text.find(','));
    const auto value = parse_number<int>(one);
    if (!value || *value < 0) return std::nullopt;
    list.push_back(*value);
    if (one.size() == text.size()) return list;
    text.remove_prefix(one.size() + 1);
  }
}

std::optional<int> parse_integer(std::string_view text) {
  const std::size_t comma = text.rfind(',');
  return parse_number<int>(comma == std::string_view::npos ? text : text.substr(comma + 1));
}

std::optional<double> channel_range_um(std::string_view channel_info) {
  const auto range = parse_number<double>(field(channel_info, "RNG"));
  const auto scale = um_per(field(channel_info, "UNT"));
  if (!range || !scale || !std::isfinite(*range) || !(*range > 0)) return std::nullopt;
  return *range * *scale;
}

}  // namespace mdof::drivers::capancdt
