#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Key: file. A file with the magic number of a recording is read as a recording; any other file is
// read as a probe log (CSV, plain text or gzip).
Result<DriverSpec> configure_replay(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
