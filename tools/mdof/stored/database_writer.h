// Who writes the database that a command means, and how the command gets its work done.
#pragma once

#include <optional>
#include <string>

#include "daemon/rpc/line/client.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// A connection to the mdofd that holds the database, which is then asked to write; nothing where
// nobody holds it: the command writes itself. Errors, before anything was sent to it. io: some
// other program writes, and the mdofd at `socket` is not there or holds another database. conflict:
// nobody writes, and the mdofd at a `socket` that is not the default one holds another database.
// `database` and `socket` are what the options gave.
Result<std::optional<rpc::Client>> mdofd_that_writes(const std::string& database,
                                                     const std::string& socket);

// The same for a command that reads: nothing where no mdofd answers for the database, which the
// command then reads itself. Error: conflict, as above.
Result<std::optional<rpc::Client>> mdofd_that_serves(const std::string& database,
                                                     const std::string& socket);

// A file as mdofd opens it: absolute, without links.
std::string canonical_path(const std::string& file);

// mdofd makes a run of a file and stores it, however long that takes; what it stored is read from
// the database.
Result<Run> stored_by(rpc::Client& mdofd, const std::string& database, std::string_view method,
                      std::string_view params);

}  // namespace mdof::tools
