// Makes text from outside (notes, names, messages of devices) safe for output on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// Whether printable() would not change the text: the text contains neither commands for the
// terminal nor changes of the writing direction.
bool is_printable(std::string_view utf8);

// Replaces each character that is not printable by "?": control characters except line end and tab,
// DEL, U+0080 to U+009F, characters that change the writing direction, and bytes that are not
// UTF-8.
std::string printable(std::string_view utf8);

// For a JSON document: writes these characters as JSON escapes. The contents of the document are
// unchanged.
std::string printable_json(std::string_view utf8);

}  // namespace mdof
