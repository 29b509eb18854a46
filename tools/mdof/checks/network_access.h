// IPAddressDeny=any in mdofd.service prevents the packaged service from using the network. A
// drop-in file of systemd permits connections to one address or network, for example of a device.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"
#include "tools/mdof/checks/doctor_checks.h"

namespace mdof::tools {

// Returns `text` unchanged if it is an IPv4 or IPv6 address or network, such as "192.168.0.7" or
// "192.168.0.0/24". Error (usage): the text is no address, or the network contains all addresses.
Result<std::string> network_address(const std::string& text);

// Writes the drop-in file that permits `address`, in a folder below `units` (/etc/systemd/system).
// Returns its path. Error: no permission to write; the message states the command that the user
// must run.
Result<std::filesystem::path> allow_address(const std::filesystem::path& units,
                                            const std::string& address);

// One diagnosis for each network device that the service may not reach. Empty if the service is not
// installed.
std::vector<Diagnosis> check_network(const Machine& machine, const daemon::Config& config);

}  // namespace mdof::tools
