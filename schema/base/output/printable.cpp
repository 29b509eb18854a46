#include "schema/base/output/printable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace mdof {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_shortest = bytes == 2 || code >= (bytes == 3 ? 0x800u : 0x10000u);
  if (!is_shortest || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, bytes, true};
}

bool is_printable(std::uint32_t code) {
  if (code < 0x20) return code == '\n' || code == '\t';
  if (code >= 0x7F && code < 0xA0) return false;
  return !(code >= 0x202A && code <= 0x202E) && !(code >= 0x2066 && code <= 0x2069);
}

// Fast check that succeeds for nearly all texts: no byte needs a closer check.
bool is_plain(std::string_view text) {
  bool plain = true;
  for (const char c : text) plain &= (c >= 0x20 && c != 0x7F) || c == '\n' || c == '\t';
  return plain;
}

// Replaces each non-printable character by the result of `made`.
template <class Made>
std::string replaced(std::string_view utf8, const Made& made) {
  std::string out;
  out.reserve(utf8.size());
  while (!utf8.empty()) {
    const Character c = first_of(utf8);
    if (c.valid && is_printable(c.code))
      out.append(utf8.substr(0, c.bytes));
    else
      out += made(c);
    utf8.remove_prefix(c.bytes);
  }
  return out;
}

}  // namespace

bool is_printable(std::string_view utf8) {
  if (is_plain(utf8)) return true;
  while (!utf8.empty()) {
    const Character c = first_of(utf8);
    if (!c.valid || !is_printable(c.code)) return false;
    utf8.remove_prefix(c.bytes);
  }
  return true;
}

std::string printable(std::string_view utf8) {
  return replaced(utf8, [](const Character&) { return std::string("?"); });
}

std::string printable_json(std::string_view utf8) {
  return replaced(utf8, [](const Character& c) {
    std::array<char, 8> text{};  // the codes of all these characters have four digits
    std::snprintf(text.data(), text.size(), "\\u%04x", c.valid ? c.code & 0xFFFF : kReplacement);
    return std::string(text.data());
  });
}

}  // namespace mdof
