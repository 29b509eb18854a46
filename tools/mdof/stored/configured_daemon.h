// The mdofd of a configuration, which holds its devices while it runs.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

// --socket of commands that have --config: `socket` stays empty unless it is given.
void add_configured_socket_option(CLI::App& command, std::string& socket);

// `given`, or the socket in the configuration.
const std::string& configured_socket(const daemon::Config& config, const std::string& given);

// Whether somebody answers there. Error: that cannot be found out, as without permission.
Result<bool> daemon_runs(const std::string& socket);

// For commands that open devices themselves. Error: mdofd runs, or nobody knows whether it does.
Status refuse_beside_daemon(const std::string& command, const std::string& socket);

}  // namespace mdof::tools
