#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: device, rate_hz, sampling_hz, sysfs_root, [[channel]] with area_mm2 and stray_pF, or
// gap_table.
Result<DriverSpec> configure_linux_iio(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
