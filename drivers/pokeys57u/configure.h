#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: serial, poll_ms, response_timeout_ms, [[channel]] with um_per_count, counting,
// most_counts_per_s.
Result<DriverSpec> configure_pokeys57u(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
