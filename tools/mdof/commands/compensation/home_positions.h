// Reads the option --home-mm of mdof compensation export and check.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/result.h"

namespace mdof::tools {

using Homes = std::vector<controllers::ExportOptions::Home>;

// Reads "X=10,Y=-20" or one number. The axis of a single number is unknown (0). Error: the text has
// another form.
Result<Homes> home_positions(const std::string& text);

// If a home position has no axis, sets the axis of the only table. Errors: a home position without
// an axis for several tables; a home position of an axis that has no table.
Status assign_home_axes(std::string_view axes, Homes& homes);

}  // namespace mdof::tools
