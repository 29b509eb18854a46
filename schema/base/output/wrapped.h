// Text in lines that are no wider than a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mdof {

// Characters, not bytes.
std::size_t text_width(std::string_view utf8);

// Words in lines of at most `width` characters; a word that is longer stays whole, so that a path
// can be copied. Every line but the first begins with `indent` spaces; no line end after the last.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

// Each line of the text that is wider than `width`, wrapped; its continuation lines begin with the
// spaces that it begins with, and `indent` more.
std::string fitted(std::string_view text, std::size_t width, std::size_t indent = 2);

}  // namespace mdof
