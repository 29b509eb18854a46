// Reads the keys of a serial line in mdofd.toml: baud, parity and stop_bits.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// A missing key leaves the member of `line` unchanged. The error for an invalid value names the
// key.
void read_serial_settings(TomlTable& table, SerialSettings& line);

}  // namespace mdof::drivers
