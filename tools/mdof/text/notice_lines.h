// Notices as a terminal shows them: a hundred of one kind are three and a count.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"

namespace mdof::tools {

// Of a code and subject with more than a few the first ones are kept, and how many more there are.
// `all`: nothing is left out.
Notices summarised(const Notices& notices, bool all = false);

// The same, a line each on the standard error, marked by its severity.
void show_notices(const Notices& notices, bool all = false);

}  // namespace mdof::tools
