#include "schema/base/json_writer.h"

#include <charconv>
#include <cmath>
#include <cstddef>

namespace mdof {
namespace {

template <class T>
void append_number(std::string& text, T x) {
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}

// Length of the UTF-8 sequence at the beginning of the text; 0: invalid. The valid ranges are those
// of RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  auto within = [&](std::size_t i, int low, int high) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const int lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead <= 0xdf) return within(1, 0x80, 0xbf) ? 2 : 0;
  if (lead >= 0xe0 && lead <= 0xef) {
    const int low = lead == 0xe0 ? 0xa0 : 0x80, high = lead == 0xed ? 0x9f : 0xbf;
    return within(1, low, high) && within(2, 0x80, 0xbf) ? 3 : 0;
  }
  if (lead >= 0xf0 && lead <= 0xf4) {
    const int low = lead == 0xf0 ? 0x90 : 0x80, high = lead == 0xf4 ? 0x8f : 0xbf;
    return within(1, low, high) && within(2, 0x80, 0xbf) && within(3, 0x80, 0xbf) ? 4 : 0;
  }
  return 0;
}

void append_escaped(std::string& text, char c) {
  // Pairs of a character and the letter of its escape.
  constexpr std::string_view kShort = "\"\"\\\\\nn\rr\tt";
  for (std::size_t i = 0; i < kShort.size(); i += 2)
    if (kShort[i] == c) {
      text += {'\\', kShort[i + 1]};
      return;
    }
  text += "\\u00";
  text += "0123456789abcdef"[c >> 4];
  text += "0123456789abcdef"[c & 15];
}

void append_string(std::string& text, std::string_view s) {
  text += '"';
  while (!s.empty()) {
    const char c = s[0];
    const std::size_t length = utf8_length(s);
    if (length == 0) {
      text += "\xef\xbf\xbd";
    } else if ((c >= 0 && c < 0x20) || c == '"' || c == '\\') {
      append_escaped(text, c);
    } else {
      text.append(s, 0, length);
    }
    s.remove_prefix(length ? length : 1);
  }
  text += '"';
}

}  // namespace

void JsonWriter::separate() {
  if (need_comma_) text_ += ',';
  need_comma_ = true;
}

JsonWriter& JsonWriter::begin_object() {
  separate();
  text_ += '{';
  need_comma_ = false;
  return *this;
}

JsonWriter& JsonWriter::end_object() {
  text_ += '}';
  need_comma_ = true;
  return *this;
}

JsonWriter& JsonWriter::begin_array() {
  separate();
  text_ += '[';
  need_comma_ = false;
  return *this;
}

JsonWriter& JsonWriter::end_array() {
  text_ += ']';
  need_comma_ = true;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  append_string(text_, name);
  text_ += ':';
  need_comma_ = false;
  return *this;
}

JsonWriter& JsonWriter::value(double x) {
  if (!std::isfinite(x)) return null();
  separate();
  append_number(text_, x + 0.0);  // + 0.0 converts -0 to 0
  return *this;
}

JsonWriter& JsonWriter::value(std::int64_t x) {
  separate();
  append_number(text_, x);
  return *this;
}

JsonWriter& JsonWriter::value(std::uint64_t x) {
  separate();
  append_number(text_, x);
  return *this;
}

JsonWriter& JsonWriter::value(bool x) {
  return raw(x ? "true" : "false");
}

JsonWriter& JsonWriter::value(std::string_view text) {
  separate();
  append_string(text_, text);
  return *this;
}

JsonWriter& JsonWriter::null() {
  return raw("null");
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

}  // namespace mdof
