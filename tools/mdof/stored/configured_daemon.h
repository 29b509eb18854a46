// Finds out whether the mdofd of a configuration runs. While it runs, it uses the devices of the
// configuration.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

// Adds --socket to commands with --config. `socket` is empty if the user does not state the option.
void add_configured_socket_option(CLI::App& command, std::string& socket);

// `given` if it is not empty, otherwise the socket in the configuration.
const std::string& configured_socket(const daemon::Config& config, const std::string& given);

// Whether a server answers at the socket. Error: the answer is unknown, for example because this
// user may not open the socket.
Result<bool> daemon_runs(const std::string& socket);

// For commands that open devices themselves. Error: mdofd runs, or it is unknown whether it runs.
Status check_daemon_stopped(const std::string& command, const std::string& socket);

}  // namespace mdof::tools
