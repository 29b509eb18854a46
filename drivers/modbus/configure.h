// Reads the keys of a Modbus device; drivers/README.md lists the keys.
#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

Result<DriverSpec> configure_modbus(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
