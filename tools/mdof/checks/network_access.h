// IPAddressDeny=any in mdofd.service limits the packaged service to connections within the
// computer. Drop-ins of systemd permit connections to devices on a network.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"
#include "tools/mdof/checks/doctor_checks.h"

namespace mdof::tools {

// Returns `text` unchanged if it is an IPv4 or IPv6 address or network, such as "192.168.0.7" or
// "192.168.0.0/24". Errors (usage): it is no address, or it contains every address.
Result<std::string> network_address(const std::string& text);

// Writes the drop-in for `address` below `units` (/etc/systemd/system) and returns its path. Error:
// no write permission; the message names the command to run.
Result<std::filesystem::path> allow_address(const std::filesystem::path& units,
                                            const std::string& address);

// One diagnosis for each network device that the service may not reach. Empty if the service is not
// installed.
std::vector<Diagnosis> check_network(const Machine& machine, const daemon::Config& config);

}  // namespace mdof::tools
