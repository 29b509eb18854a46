// What would keep mdofd from starting with a configuration that is right in itself: said before
// anything is opened, each with file, line, key and remedy.
#pragma once

#include <string>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Folders of database, recordings and socket that are not there and cannot be made, or not be
// written to; files in their place; devices that are one and the same.
Status check_start(const Config& config);

// Makes the folder of the socket, and those above it, for all to pass and its owner to write to.
// One that is there stays as it is.
Status make_socket_folder(const std::string& socket);

// What to do where there is no configuration at `file`: a first one to copy, with the simulator.
std::string first_configuration(const std::string& file);

}  // namespace mdof::daemon
