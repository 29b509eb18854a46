#include "schema/base/output/wrapped.h"

#include <algorithm>

namespace mdof {
namespace {

std::string with_margin(std::string_view lines, std::size_t spaces) {
  std::string out(spaces, ' ');
  for (const char c : lines) {
    out += c;
    if (c == '\n') out.append(spaces, ' ');
  }
  return out;
}

}  // namespace

// In UTF-8 only continuation bytes begin with the bits 10.
std::size_t text_width(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t used = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t wide = text_width(word);
    if (used > 0 && used + 1 + wide > width) {
      out.append("\n").append(indent, ' ').append(word);
      used = indent + wide;
    } else {
      out.append(out.empty() ? "" : " ").append(word);
      used += wide + (used > 0 ? 1 : 0);
    }
  }
  return out;
}

std::string fitted(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t spaces = std::min(line.find_first_not_of(' '), line.size());
    if (text_width(line) <= width || spaces >= width)
      out += line;
    else
      out += with_margin(wrapped(line.substr(spaces), width - spaces, indent), spaces);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace mdof
