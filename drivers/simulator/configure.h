#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: see options.h.
Result<DriverSpec> configure_simulator(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
