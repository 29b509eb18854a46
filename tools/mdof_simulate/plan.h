// The plan of mdof-simulate: a simulated machine and the devices that measure it (README.md lists
// the keys). The kernel module vhci-hcd connects USB devices to the bus of this computer; they are
// unplugged when mdof-simulate ends.
#pragma once

#include <filesystem>
#include <vector>

#include "schema/base/result.h"
#include "tools/mdof_simulate/server.h"

namespace mdof::simulate {

// Errors name file, line and key.
Result<std::vector<Served>> load_plan(const std::filesystem::path& file);

}  // namespace mdof::simulate
