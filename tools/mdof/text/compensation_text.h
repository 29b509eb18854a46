// Compensation tables as text for people; their documents are in daemon/measure/gate.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/measure/gate/table_documents.h"
#include "schema/compensation_table.h"

namespace mdof::tools {

// `generation`: 0 where the table is not active.
std::string table_text(const CompensationTable& table, std::int64_t generation);
std::string list_text(const daemon::ListedTables& list);

}  // namespace mdof::tools
