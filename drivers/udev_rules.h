// The rules of udev that let the group mdof, and whoever is logged in, use the devices of mdof.
#pragma once

#include <string>
#include <vector>

#include "drivers/registry.h"

namespace mdof::drivers {

// The text of daemon/systemd/60-mdof.rules.
std::string udev_rules(const std::vector<DriverRow>& rows);

}  // namespace mdof::drivers
