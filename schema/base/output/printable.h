// Makes text from outside (notes, names, messages of devices) safe for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// Whether a terminal interprets no part of the text as a command or as a change of writing
// direction.
bool is_printable(std::string_view utf8);

// Replaces each non-printable character by "?": control characters except line end and tab, DEL,
// U+0080 to U+009F, the marks of writing direction, and bytes that are not UTF-8.
std::string printable(std::string_view utf8);

// For a JSON document: writes these characters as escapes, so the content is unchanged.
std::string printable_json(std::string_view utf8);

}  // namespace mdof
