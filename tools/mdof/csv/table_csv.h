// A compensation table as CSV.
#pragma once

#include <string>

#include "schema/compensation_table.h"

namespace mdof::tools {

// One row for each position: errors (actual - nominal) and their standard uncertainties, forward
// and reverse.
std::string table_csv(const CompensationTable& table);

}  // namespace mdof::tools
