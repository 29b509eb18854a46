// Reads the table [axis.device] with driver = "mcc_usb1608fs_plus" (keys: drivers/README.md).
#pragma once

#include "drivers/driver_spec.h"
#include "drivers/mcc_usb1608fs_plus/settings.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// Reads all keys and rejects unknown keys. Errors name file, line and key.
Result<mcc_usb1608fs_plus::Settings> read_mcc_usb1608fs_plus(TomlTable& table,
                                                             const DriverContext& context);
Result<DriverSpec> configure_mcc_usb1608fs_plus(TomlTable& table, const DriverContext& context);

}  // namespace mdof::drivers
