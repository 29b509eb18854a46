#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: source ("tcp://HOST:PORT" or "fifo:PATH") or command (a list), start_s, silence_s,
// bad_lines, absolute.
Result<DriverSpec> configure_csv_stream(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
