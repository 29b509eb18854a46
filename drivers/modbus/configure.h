// The keys of a Modbus device; drivers/README.md lists them.
#pragma once

#include "drivers/registry.h"

namespace mdof::drivers {

Result<DriverSpec> configure_modbus(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
