// Default paths of the state and the socket. An option or the environment can override them.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::daemon {

// $STATE_DIRECTORY/mdof.db, else $XDG_STATE_HOME/mdof/mdof.db, else ~/.local/state/mdof/mdof.db.
Result<std::filesystem::path> default_database();
// $RUNTIME_DIRECTORY/mdof.sock, else $XDG_RUNTIME_DIR/mdof.sock, else /run/mdof/mdof.sock.
std::string default_socket();

// The present time, for people and file names: "2026-11-21T08:15:30.123Z".
std::string utc_now();

}  // namespace mdof::daemon
