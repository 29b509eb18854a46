// Checks whether mdofd can start with a valid configuration, before anything is opened. Errors
// state file, line, key and remedy.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Errors: folders of the database, the recordings or the socket that are missing and cannot be
// created, or are not writable; other files with these paths; two entries for the same device.
Status check_start(const Config& config);

// Creates the folder of the socket and its parents, searchable by all and writable by the owner. An
// existing folder does not change.
Status make_socket_folder(const std::string& socket);

// The message if `file` does not exist. It contains a first configuration with the simulator.
std::string first_configuration(const std::string& file);

}  // namespace mdof::daemon
