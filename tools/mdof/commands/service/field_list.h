// mdof help fields: describes the JSON members and CSV columns of mdof's output.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

std::string field_list(std::size_t width);  // Sorted by name.
// Describes one field. `name` may contain or omit the groups before the name. Error: no such field.
Result<std::string> field_text(const std::string& name, std::size_t width);

}  // namespace mdof::tools
