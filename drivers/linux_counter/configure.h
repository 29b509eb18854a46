#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: device, chip, function, ceiling, rate_hz, sysfs_root, [[channel]] with um_per_count.
Result<DriverSpec> configure_linux_counter(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
