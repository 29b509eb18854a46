// Reads the table [axis.device] with driver = "labjack_u6" (keys: drivers/README.md).
#pragma once

#include "drivers/driver_spec.h"
#include "drivers/labjack_u6/settings.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Reads all keys and rejects unknown keys. Errors name file, line and key.
Result<labjack_u6::Settings> read_labjack_u6(TomlTable& table, const DriverContext& context);
Result<DriverSpec> configure_labjack_u6(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
