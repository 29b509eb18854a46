// Formats any JSON as text, so that the reply of a newer daemon is shown even if this mdof does not
// know its members.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// One line for each member; an array of objects is a table. Text that is not JSON is returned
// unchanged.
std::string readable(std::string_view json);

}  // namespace mdof::tools
