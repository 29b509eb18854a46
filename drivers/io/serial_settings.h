// A serial line in mdofd.toml: the keys baud, parity and stop_bits of a device.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// What is not given stays as it is in `line`. What is wrong is rejected by its key.
void read_serial_settings(TomlTable& table, SerialSettings& line);

}  // namespace mdof::drivers
