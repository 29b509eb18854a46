// Finds the process that writes the database of a command, and connects to it.
#pragma once

#include <optional>
#include <string>

#include "daemon/rpc/line/client.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof::tools {

// For a command that writes. If an mdofd uses the database, returns a connection to it: the command
// must ask mdofd to write. nullopt: no process has opened the database for writing, and the command
// writes itself. `database` and `socket` are the values of the options.
// Errors; nothing was sent then:
// - io: another process writes the database, but no mdofd answers at `socket`, or the mdofd there
// uses another database
// - conflict: no process writes the database, `socket` is not the default, and the mdofd there uses
// another database
Result<std::optional<rpc::Client>> writing_daemon(const std::string& database,
                                                  const std::string& socket);

// For a command that reads. nullopt: no mdofd that uses the database answers, and the command reads
// it itself. Error: conflict, as for writing_daemon().
Result<std::optional<rpc::Client>> serving_daemon(const std::string& database,
                                                  const std::string& socket);

// The path of the file as mdofd uses it: absolute, without symbolic links.
std::string canonical_path(const std::string& file);

// Calls the method `method`, with which mdofd makes a run from a file and stores it. Waits up to 24
// h. Then reads the stored run from the database.
Result<Run> store_in_daemon(rpc::Client& mdofd, const std::string& database,
                            std::string_view method, std::string_view params);

}  // namespace mdof::tools
