// JSON documents of stored tables, for the command line and the RPC methods.
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

// Selects the points of a table, or the items of a list, that a document contains: at most `count`,
// from index `offset`. The document ends earlier if it would be longer than `most_bytes`.
struct DocumentPage {
  std::int64_t offset = 0, count = std::numeric_limits<std::int64_t>::max();
  std::size_t most_bytes = std::numeric_limits<std::size_t>::max();
};

// Selects the first `count` points of a table. The page is limited so that the points and these
// notices fit into one reply.
DocumentPage page_with_notices(const Notices& notices, std::int64_t count);

// `generation`: 0 if the table is not active. `doubtful`: whether the table or one of its runs has
// a doubtful notice.
std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful,
                           const DocumentPage& page = {});
std::string volumetric_document(const VolumetricTable& table, std::int64_t generation,
                                bool doubtful, const DocumentPage& page = {});

// Lists of axis tables and volumetric tables from index `offset`, with the generation of each
// table.
struct ListedTables {
  std::vector<CompensationTable> tables;
  std::vector<VolumetricTable> volumes;
  std::vector<std::int64_t> generations, volume_generations;
  std::int64_t generation = 0;  // generation of all active tables
  std::int64_t offset = 0;
  bool only_volumes = false;  // the document contains only volumetric tables, as member "tables"
};
// The document contains as many items of both lists as fit into `most_bytes`. Both lists end at the
// same index, so that one offset is enough to request the next page.
std::string list_document(const ListedTables& list,
                          std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

}  // namespace mdof::daemon
