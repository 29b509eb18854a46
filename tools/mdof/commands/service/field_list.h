// mdof help fields: describes the names of members and columns.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

std::string field_list(std::size_t width);  // Sorted by name.
// Accepts a name with or without its groups.
Result<std::string> field_text(const std::string& name, std::size_t width);

}  // namespace mdof::tools
