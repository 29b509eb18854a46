// Reads the table [axis.device] with driver = "linux_comedi" (keys: drivers/README.md).
#pragma once

#include "drivers/driver_spec.h"
#include "drivers/linux_comedi/settings.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Reads all keys and rejects unknown keys. Errors name file, line and key.
Result<linux_comedi::Settings> read_linux_comedi(TomlTable& table, const DriverContext& context);
Result<DriverSpec> configure_linux_comedi(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
