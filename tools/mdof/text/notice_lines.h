// Prints notices. If there are many notices of one kind, prints three of them and the number of the
// others.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"

namespace mdof::tools {

// If several notices have the same code and subject, keeps the first ones and adds the number of
// the others. `all`: keeps every notice. It may be false only in a command that has the option
// --all-warnings, because the text about the others names this option.
Notices summarised(const Notices& notices, bool all);

// Prints the summarised notices to the standard error, one line each, with their severity.
void show_notices(const Notices& notices, bool all);

}  // namespace mdof::tools
