#include "drivers/qsb/protocol.h"

#include <charconv>
#include <cstdio>

namespace mdof::drivers {
namespace {

std::string hex(std::uint32_t value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "%0*X", digits, value);
  return text;
}

// Reads exactly `digits` hexadecimal digits at the beginning of `text` and removes them.
std::optional<std::uint32_t> take_hex(std::string_view& text, std::size_t digits) {
  std::uint32_t value = 0;
  if (text.size() < digits) return std::nullopt;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + digits, value, 16);
  if (error != std::errc() || stop != text.data() + digits) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool take_space(std::string_view& text) {
  if (!text.starts_with(' ')) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::string qsb_command(char type, std::uint8_t reg, std::optional<std::uint32_t> data) {
  return type + hex(reg, 2) + (data ? hex(*data, 8) : "") + "\r\n";
}

std::string qsb_line(const QsbReply& reply, std::uint32_t eor) {
  const char* const space = eor & qsb::kEorSpaces ? " " : "";
  std::string line = reply.type + (space + hex(reply.reg, 2)) + space + hex(reply.data, 8);
  if (reply.stamp && (eor & qsb::kEorStamp)) line += space + hex(*reply.stamp, 8);
  line += std::string(space) + "!";
  if (eor & qsb::kEorCr) line += '\r';
  if (eor & qsb::kEorLf) line += '\n';
  return line;
}

std::optional<QsbReply> parse_qsb_line(std::string_view line) {
  QsbReply reply;
  if (line.empty() || std::string_view("rwsex").find(line[0]) == std::string_view::npos)
    return std::nullopt;
  reply.type = line[0];
  line.remove_prefix(1);
  if (!take_space(line)) return std::nullopt;
  const auto reg = take_hex(line, 2);
  if (!reg || !take_space(line)) return std::nullopt;
  const auto data = take_hex(line, 8);
  if (!data || !take_space(line)) return std::nullopt;
  reply.reg = static_cast<std::uint8_t>(*reg);
  reply.data = *data;
  if (line == "!") return reply;
  reply.stamp = take_hex(line, 8);
  if (!reply.stamp || line != " !") return std::nullopt;
  return reply;
}

bool is_qsb_banner(std::string_view line) {
  return line.find("QSB") != std::string_view::npos;
}

QsbIdentity qsb_identity(std::uint32_t version) {
  static constexpr const char* kModels[] = {"QSB-D", "QSB-M", "QSB-S"};
  const std::uint32_t type = version >> 8 & 0xF;
  return {hex(version >> 12, 5), type < 3 ? kModels[type] : "QSB",
          static_cast<int>(version & 0xFF)};
}

}  // namespace mdof::drivers
