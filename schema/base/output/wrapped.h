// Wraps text to the width of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mdof {

// Width in characters, not bytes.
std::size_t text_width(std::string_view utf8);

// Puts words into lines of at most `width` characters. A longer word is not split, so that a path
// can be copied. Every line but the first begins with `indent` spaces; no line end after the last.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

// Wraps each line of the text that is wider than `width`. Its continuation lines begin with the
// leading spaces of the line and `indent` more.
std::string fitted(std::string_view text, std::size_t width, std::size_t indent = 2);

}  // namespace mdof
