// A compensation table as CSV.
#pragma once

#include <string>

#include "schema/compensation_table.h"

namespace mdof::tools {

// One row for each position, with the errors (actual - nominal) and their standard uncertainties in
// forward and in reverse approach.
std::string table_csv(const CompensationTable& table);

}  // namespace mdof::tools
