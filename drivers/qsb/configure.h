#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: port or address, baud, rts, counting, interval, serial, one [[channel]] with um_per_count.
Result<DriverSpec> configure_qsb(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
