// Writes results to the standard output and messages for people to the standard error. Both may
// contain free text from other sources. A character that a terminal would execute as a command is
// written as "?", or as an escape if the text is a JSON document.
#pragma once

#include <string_view>

#include "schema/base/result.h"

namespace mdof::tools {

// Writes the whole text unbuffered. If the reader has closed the pipe (mdof ... | head), the
// program exits quietly with success.
Status write_out(std::string_view text);
Status write_line(std::string_view text);  // Adds a line end.
// Writes the text unchanged, for a screen with its own control characters or for rows of numbers,
// which need no check. Free text in it must have passed printable().
Status write_commands(std::string_view text);

// Writes a message to the standard error: wrapped to the width of a terminal, otherwise in one line
// for journals and scripts.
void say(std::string_view message);
void warn(std::string_view message);  // The same, with "warning: " in front.

bool out_is_terminal();
bool messages_are_on_terminal();

}  // namespace mdof::tools
