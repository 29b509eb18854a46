#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Key: file. A recording (detected by its magic), otherwise a probe log: CSV, plain or gzip.
Result<DriverSpec> configure_replay(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
