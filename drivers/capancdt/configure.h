// Keys of [axis.device] with driver = "capancdt".
#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// address (port 23 if none is given), data_port, serial, configure, sample_time_us, averaging,
// averaged_values, guard_counts; [[channel]] id, input = "1" ... "32", range_um.
Result<DriverSpec> configure_capancdt(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
