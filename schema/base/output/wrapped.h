// Wraps text to the width of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mdof {

// Width in characters, not bytes.
std::size_t text_width(std::string_view utf8);

// Puts words into lines of at most `width` characters. A word that is longer than a line is not
// divided, so that a path can be copied. All lines except the first begin with `indent` spaces.
// There is no line end after the last line.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

// Wraps each line of the text that is longer than `width`. The continuation lines begin with the
// leading spaces of the line, plus `indent` spaces.
std::string fitted(std::string_view text, std::size_t width, std::size_t indent = 2);

}  // namespace mdof
