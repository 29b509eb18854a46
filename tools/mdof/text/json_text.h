// Any JSON as text for people: what a newer daemon says is shown even if this mdof does not know
// it.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// Members line by line, an array of objects as a table. Text that is no JSON comes back as it is.
std::string readable(std::string_view json);

}  // namespace mdof::tools
