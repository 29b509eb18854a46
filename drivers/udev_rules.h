// The udev rules that permit the group mdof and the logged-in user to use the devices of mdof.
#pragma once

#include <string>
#include <vector>

#include "drivers/registry.h"

namespace mdof::drivers {

// The text of daemon/systemd/60-mdof.rules.
std::string udev_rules(const std::vector<DriverRow>& rows);

}  // namespace mdof::drivers
