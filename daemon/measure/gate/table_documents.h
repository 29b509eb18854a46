// Stored tables as the command line and the RPC give them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::daemon {

// Which points of a table, or entries of a list, a document has: from `offset` on at most `count`,
// and no more than fit.
struct DocumentPage {
  std::int64_t offset = 0, count = std::numeric_limits<std::int64_t>::max();
  std::size_t most_bytes = std::numeric_limits<std::size_t>::max();
};

// The first points of a table that was built, as many as fit into a reply beside these notices.
DocumentPage page_beside(const Notices& notices, std::int64_t count);

// `generation`: 0 where the table is not active; `doubtful`: by its runs or by itself.
std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful,
                           const DocumentPage& page = {});
std::string volumetric_document(const VolumetricTable& table, std::int64_t generation,
                                bool doubtful, const DocumentPage& page = {});

// Tables of axes and of volumes from `offset` on, with the generation of each.
struct ListedTables {
  std::vector<CompensationTable> tables;
  std::vector<VolumetricTable> volumes;
  std::vector<std::int64_t> generations, volume_generations;
  std::int64_t generation = 0;  // of all active tables
  std::int64_t offset = 0;
  bool only_volumes = false;  // they are asked for alone, and are "tables" then
};
// As many of both as fit into `most_bytes`: where one list is cut, the other is cut at the same
// place, so that the next page begins at one offset.
std::string list_document(const ListedTables& list,
                          std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

}  // namespace mdof::daemon
