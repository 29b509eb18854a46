// Text from outside (notes, names, messages of devices) as it may reach a terminal.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

// Whether a terminal takes no part of it as a command, or as an order to turn the text round.
bool is_printable(std::string_view utf8);

// The same with "?" for each character that is not printable: control characters but line end and
// tab, DEL, U+0080 to U+009F, the marks of writing direction, bytes that are no UTF-8.
std::string printable(std::string_view utf8);

// Of a JSON document: the same characters as escapes, so that it says what it said.
std::string printable_json(std::string_view utf8);

}  // namespace mdof
