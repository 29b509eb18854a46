#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: either source ("tcp://HOST:PORT", "fifo:PATH" or "serial:/dev/...") or command (a list);
// header, start_s, silence_s, bad_lines, absolute. A serial line also has baud, parity and
// stop_bits.
Result<DriverSpec> configure_csv_stream(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
