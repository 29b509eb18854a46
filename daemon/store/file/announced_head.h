// The file "FILE.head" in the folder of the database. It contains the head of the chain of hashes
// that mdofd announced last (in the journal and in server.info). At the next start, mdofd compares
// this head with the chain. mdofd thus detects a chain that was cut or recalculated, and links that
// were lost with a -wal file. In these cases, an older table is not served as active.
#pragma once

#include <filesystem>

#include "daemon/store/ledger.h"
#include "schema/base/result.h"

namespace mdof::store {

std::filesystem::path announced_head_file(const std::filesystem::path& database);
struct AnnouncedHead {
  ChainHead head;               // link 0: no head was announced, or the file cannot be read
  std::int64_t generation = 0;  // generation of the active tables
};
AnnouncedHead read_announced_head(const std::filesystem::path& database);
// Replaces the file atomically, without a disk flush. After a power failure, an older head is
// sufficient.
Status write_announced_head(const std::filesystem::path& database, const AnnouncedHead& announced);

}  // namespace mdof::store
