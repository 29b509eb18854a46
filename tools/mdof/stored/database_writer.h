// Determines which process writes the database of a command, and connects to it.
#pragma once

#include <optional>
#include <string>

#include "daemon/rpc/line/client.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// Returns a connection to the mdofd that holds the database and has to write for the command;
// nullopt if no process holds the database, so that the command writes itself. `database` and
// `socket` are the values of the options. Nothing has been sent before an error. Errors:
// io: another program writes, and no mdofd answers at `socket` or it holds another database;
// conflict: no program writes, and the mdofd at a `socket` other than the default holds another
// database.
Result<std::optional<rpc::Client>> writing_daemon(const std::string& database,
                                                  const std::string& socket);

// The same for a command that reads: nullopt if no mdofd answers for the database, so that the
// command reads it itself. Error: conflict, as above.
Result<std::optional<rpc::Client>> serving_daemon(const std::string& database,
                                                  const std::string& socket);

// The path under which mdofd opens the file: absolute, without links.
std::string canonical_path(const std::string& file);

// Asks mdofd to make and store a run from a file, and waits as long as this takes. Reads the stored
// run from the database.
Result<Run> store_in_daemon(rpc::Client& mdofd, const std::string& database,
                            std::string_view method, std::string_view params);

}  // namespace mdof::tools
