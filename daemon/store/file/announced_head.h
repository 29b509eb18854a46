// "FILE.head", a file beside the database: the head of the chain of hashes that mdofd announced
// last (journal, server.info). With it, the next start detects a chain that was cut, recalculated
// or lost with a -wal file, so that no older table is served as active.
#pragma once

#include <filesystem>

#include "daemon/store/ledger.h"
#include "schema/base/result.h"

namespace mdof::store {

std::filesystem::path announced_head_file(const std::filesystem::path& database);
struct AnnouncedHead {
  ChainHead head;               // link 0: none was announced, or the file is unreadable
  std::int64_t generation = 0;  // generation of the active tables
};
AnnouncedHead read_announced_head(const std::filesystem::path& database);
// Replaces the file atomically. Not flushed, because an older head is sufficient after a power
// failure.
Status write_announced_head(const std::filesystem::path& database, const AnnouncedHead& announced);

}  // namespace mdof::store
