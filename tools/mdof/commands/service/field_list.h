// The names of members and columns for people: mdof help fields.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

std::string field_list(std::size_t width);  // sorted by name
// Of a name with its groups, or without.
Result<std::string> field_text(const std::string& name, std::size_t width);

}  // namespace mdof::tools
