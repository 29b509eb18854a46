// The packaged service may speak with its own machine only (IPAddressDeny=any of mdofd.service);
// drop-ins of systemd open it to devices on a network.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"
#include "tools/mdof/checks/doctor_checks.h"

namespace mdof::tools {

// "192.168.0.7", "192.168.0.0/24", or of IPv6, as it was given. Error (usage): none of these, or
// every address there is.
Result<std::string> network_address(const std::string& text);

// Writes the drop-in for `address` below `units` (/etc/systemd/system) and gives its path. Errors:
// no right to write there, with the command that has it.
Result<std::filesystem::path> allow_address(const std::filesystem::path& units,
                                            const std::string& address);

// Of the devices that are reached through a network; none where the service is not installed, or
// may reach them all.
std::vector<Diagnosis> check_network(const Machine& machine, const daemon::Config& config);

}  // namespace mdof::tools
