// The names of members and columns for people: mdof help fields.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// Sorted by name; a line each, where no width is given.
std::string field_list(std::optional<std::size_t> width = {});
Result<std::string> field_text(const std::string& name);  // of a name with its groups, or without

}  // namespace mdof::tools
