// Compensation tables as text. daemon/measure/gate writes them as JSON.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/measure/gate/table_documents.h"
#include "schema/compensation_table.h"

namespace mdof::tools {

// `generation`: 0 if the table is not active.
std::string table_text(const CompensationTable& table, std::int64_t generation);
std::string list_text(const daemon::ListedTables& list);

}  // namespace mdof::tools
