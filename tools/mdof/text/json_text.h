// Formats any JSON as text. mdof can thus show the reply of a newer mdofd even if it does not know
// all members.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// One line for each member; an array of objects is a table. Text that is not JSON is returned
// unchanged.
std::string readable(std::string_view json);

}  // namespace mdof::tools
