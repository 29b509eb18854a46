// Writes results to the standard output, and messages for the user to the standard error. A text
// may contain characters from other sources that a terminal would execute as a command. Such a
// character is written as "?", or as an escape sequence if the text is a JSON document.
#pragma once

#include <string_view>

#include "schema/base/result.h"

namespace mdof::tools {

// Writes the whole text unbuffered. If the reader has closed the pipe (mdof ... | head), the
// program exits quietly with success.
Status write_out(std::string_view text);
Status write_line(std::string_view text);  // Adds a line end.
// Writes the text unchanged: for a text with intended control characters, or for rows of numbers.
// If the text contains free text from other sources, the caller must check this part with
// printable().
Status write_commands(std::string_view text);

// Writes a message to the standard error. On a terminal the message is wrapped to the width;
// otherwise it is one line, for journals and scripts.
void say(std::string_view message);
void warn(std::string_view message);  // The same, with "warning: " in front.

bool out_is_terminal();
bool messages_are_on_terminal();

}  // namespace mdof::tools
