// Compensation tables as JSON documents and as text for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/compensation_table.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::tools {

// `generation`: 0 where the table is not active; `doubtful`: by its runs.
std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful);
std::string table_text(const CompensationTable& table, std::int64_t generation);

// Tables of axes and of volumes with the generation of each.
struct ListedTables {
  std::vector<CompensationTable> tables;
  std::vector<VolumetricTable> volumes;
  std::vector<std::int64_t> generations, volume_generations;
  std::int64_t generation = 0;  // of all active tables
};
std::string list_document(const ListedTables& list);
std::string list_text(const ListedTables& list);

}  // namespace mdof::tools
