// The mdofd that a configuration belongs to; it holds its devices while it runs.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

// Adds --socket to commands with --config. `socket` stays empty unless the option is given.
void add_configured_socket_option(CLI::App& command, std::string& socket);

// `given` if it is not empty, otherwise the socket in the configuration.
const std::string& configured_socket(const daemon::Config& config, const std::string& given);

// Whether a server answers at the socket. Error: this cannot be determined, for example without
// permission.
Result<bool> daemon_runs(const std::string& socket);

// For commands that open devices themselves. Error: mdofd runs, or it cannot be determined whether
// it runs.
Status check_daemon_stopped(const std::string& command, const std::string& socket);

}  // namespace mdof::tools
