// Option --home-mm of mdof compensation export and check.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/result.h"

namespace mdof::tools {

using Homes = std::vector<controllers::ExportOptions::Home>;

// Reads "X=10,Y=-20", or one number, whose axis is still unknown. Error: the text is neither.
Result<Homes> home_positions(const std::string& text);

// Assigns a number without axis to the axis of the only table. Errors: a number for several tables;
// a home of an axis without a table.
Status assign_home_axes(std::string_view axes, Homes& homes);

}  // namespace mdof::tools
