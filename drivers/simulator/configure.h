#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Reads the keys in options.h.
Result<DriverSpec> configure_simulator(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
