// The plan of mdof-simulate: a machine, and the devices that look at it (README.md has the keys).
// USB devices are put on the bus of this machine by the kernel's module vhci-hcd, and are unplugged
// when mdof-simulate ends.
#pragma once

#include <filesystem>
#include <vector>

#include "schema/base/result.h"
#include "tools/mdof_simulate/server.h"

namespace mdof::simulate {

// Errors name file, line and key.
Result<std::vector<Served>> load_plan(const std::filesystem::path& file);

}  // namespace mdof::simulate
