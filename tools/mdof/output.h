// The two ways out: results to the standard output, messages for people to the standard error. Free
// text of others may be in both: what a terminal would take as a command is written as "?", or as
// an escape where the text is a JSON document.
#pragma once

#include <string_view>

#include "schema/base/result.h"

namespace mdof::tools {

// Writes all of it, unbuffered. A reader who has gone (mdof ... | head) ends the program quietly
// with success: nobody is left to read it.
Status write_out(std::string_view text);
Status write_line(std::string_view text);  // and a line end
// As it is: a screen with control characters of its own, or rows of numbers, which need no look.
// Free text in it has to be printable().
Status write_commands(std::string_view text);

// A message on the standard error: on a terminal in lines that are no wider, else in one line, as
// journals and scripts take it.
void say(std::string_view message);
void warn(std::string_view message);  // the same, marked "warning: "

bool out_is_terminal();
bool messages_are_on_terminal();

}  // namespace mdof::tools
