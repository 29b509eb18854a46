// Every driver by the name that it has in the configuration: one row each in registry.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drivers/driver_spec.h"
#include "drivers/linux_node.h"
#include "drivers/simulated_wiring.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {

// The simulated twin of a device, as mdof-simulate serves it: a kind of the name of its driver.
struct SimulatedKind {
  std::size_t most_inputs;
  const char* inputs;   // for people: "up to 14 probes, in volts, and the encoder"
  const char* reached;  // where a program reaches it: "TCP: command, stream"
  MakeSimulated make;
};

// All that mdof knows of a driver outside its folder.
struct DriverRow {
  const char* name;     // in the configuration
  const char* folder;   // of drivers/
  const char* devices;  // one line: which devices, and through what
  Result<DriverSpec> (*configure)(TomlTable&, const DriverContext&);
  std::optional<LinuxNode> node = std::nullopt;           // none: on a network, a file, a script
  std::optional<SimulatedKind> simulated = std::nullopt;  // none: it needs the kernel, or no device
  // Why `index_mm` of an encoder is refused; null: the driver knows for certain that its mark was
  // passed (counter/index_mark.h).
  const char* no_index = "this device has no counter and detects no reference mark";
};
const std::vector<DriverRow>& driver_rows();  // by name
const DriverRow* find_driver(const std::string& name);

// Reads the driver's keys from `table` (whose `driver` and `name` the caller has taken) and
// finishes it. Errors name file, line and key; for an unknown driver the known ones.
Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context);

}  // namespace mdof::drivers
