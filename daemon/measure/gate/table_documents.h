// Documents of stored tables for the command line and the RPC.
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

// The points of a table or entries of a list that a document contains: at most `count` from
// `offset`, and no more than fit.
struct DocumentPage {
  std::int64_t offset = 0, count = std::numeric_limits<std::int64_t>::max();
  std::size_t most_bytes = std::numeric_limits<std::size_t>::max();
};

// The first points of a calculated table, as many as fit into a reply together with these notices.
DocumentPage page_with_notices(const Notices& notices, std::int64_t count);

// `generation`: 0 if the table is not active; `doubtful`: because of its runs or its own notices.
std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful,
                           const DocumentPage& page = {});
std::string volumetric_document(const VolumetricTable& table, std::int64_t generation,
                                bool doubtful, const DocumentPage& page = {});

// Tables of axes and of volumes from `offset`, with the generation of each.
struct ListedTables {
  std::vector<CompensationTable> tables;
  std::vector<VolumetricTable> volumes;
  std::vector<std::int64_t> generations, volume_generations;
  std::int64_t generation = 0;  // generation of all active tables
  std::int64_t offset = 0;
  bool only_volumes = false;  // only volumes are requested; the document lists them as "tables"
};
// The document contains as many of both lists as fit into `most_bytes`. Both lists are cut at the
// same index, so that the next page begins at one offset.
std::string list_document(const ListedTables& list,
                          std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

}  // namespace mdof::daemon
