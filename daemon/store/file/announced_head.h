// "FILE.head": the head of the chain of hashes that mdofd announced last (journal, server.info),
// beside the database and not in it. A chain that was cut, calculated anew, or lost with a -wal
// file is then noticed at the next start, and no older table is served as the active one.
#pragma once

#include <filesystem>

#include "daemon/store/ledger.h"
#include "schema/base/result.h"

namespace mdof::store {

std::filesystem::path announced_head_file(const std::filesystem::path& database);
struct AnnouncedHead {
  ChainHead head;               // link 0: none was announced, or the file cannot be read
  std::int64_t generation = 0;  // of the active tables
};
AnnouncedHead read_announced_head(const std::filesystem::path& database);
// Replaces the file in one step. Not flushed: after a power cut an older head is as good.
Status write_announced_head(const std::filesystem::path& database, const AnnouncedHead& announced);

}  // namespace mdof::store
