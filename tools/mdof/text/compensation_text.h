// Compensation tables as JSON documents and as text for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/compensation_table.h"

namespace mdof::tools {

// `generation`: 0 where the table is not in force; `doubtful`: by its runs.
std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful);
std::string table_text(const CompensationTable& table, std::int64_t generation);

std::string list_document(const std::vector<CompensationTable>& tables,
                          const std::vector<std::int64_t>& generations);
std::string list_text(const std::vector<CompensationTable>& tables,
                      const std::vector<std::int64_t>& generations);

}  // namespace mdof::tools
