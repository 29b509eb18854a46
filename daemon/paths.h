// Default paths of the database and the socket, which depend on environment variables. An option of
// mdof or a key of mdofd.toml overrides a default path.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::daemon {

// The first path whose variable is set: $STATE_DIRECTORY/mdof.db, $XDG_STATE_HOME/mdof/mdof.db,
// ~/.local/state/mdof/mdof.db.
Result<std::filesystem::path> default_database();
// The first path whose variable is set: $RUNTIME_DIRECTORY/mdof.sock, $XDG_RUNTIME_DIR/mdof.sock;
// otherwise /run/mdof/mdof.sock.
std::string default_socket();

// The current time in UTC, as text for people and file names: "2026-11-21T08:15:30.123Z".
std::string utc_now();

}  // namespace mdof::daemon
