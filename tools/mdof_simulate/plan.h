// Reads the plan of mdof-simulate: a simulated machine, and simulated devices that measure it.
// tools/mdof_simulate/README.md lists the keys.
#pragma once

#include <filesystem>
#include <vector>

#include "schema/base/result.h"
#include "tools/mdof_simulate/server.h"

namespace mdof::simulate {

// Errors name file, line and key.
Result<std::vector<Served>> load_plan(const std::filesystem::path& file);

}  // namespace mdof::simulate
