// Checks whether mdofd can start with a configuration that load_config() has accepted, before mdofd
// opens any file or device. Errors state file, line, key and remedy.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Errors:
//   - a folder (database, recordings, socket, token file) is missing and cannot be created;
//   - a folder or file is not writable;
//   - the path of the socket is another kind of file;
//   - two tables of the configuration state the same device.
Status check_start(const Config& config);

// Creates the folder of the socket and its parent folders. All users can enter these folders, and
// only the owner can write in them. A folder that exists does not change.
Status make_socket_folder(const std::string& socket);

// The message if the configuration `file` does not exist. It contains an example configuration with
// the simulator.
std::string first_configuration(const std::string& file);

}  // namespace mdof::daemon
