// Keys of a serial line in mdofd.toml: baud, parity and stop_bits of a device.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Missing keys leave `line` unchanged. Invalid values are rejected at their keys.
void read_serial_settings(TomlTable& table, SerialSettings& line);

}  // namespace mdof::drivers
