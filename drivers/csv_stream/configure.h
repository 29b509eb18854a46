#pragma once

#include "drivers/driver_spec.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Keys: source ("tcp://HOST:PORT", "fifo:PATH" or "serial:/dev/...") or command (a list), header,
// start_s, silence_s, bad_lines, absolute; for a serial line also baud, parity, stop_bits.
Result<DriverSpec> configure_csv_stream(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
