// All drivers, by their names in the configuration: one row each in registry.cpp.
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

// The simulated twin of a device. mdof-simulate serves it as a kind with the name of its driver.
struct SimulatedKind {
  std::size_t most_inputs;
  const char* inputs;   // for users: "up to 14 probes, in volts, and the encoder"
  const char* reached;  // how a program connects to it: "TCP: command, stream"
  MakeSimulated make;
};

// All facts about a driver that other folders need.
struct DriverRow {
  const char* name;     // in the configuration
  const char* folder;   // in drivers/
  const char* devices;  // one line: the devices and their connection
  Result<DriverSpec> (*configure)(TomlTable&, const DriverContext&);
  std::optional<LinuxNode> node = std::nullopt;  // none: a network device, a file, a script
  std::optional<SimulatedKind> simulated = std::nullopt;  // none: no twin (README.md)
  // Why `index_mm` of an encoder is refused; nullptr: the driver reliably detects that the axis
  // passes the mark (counter/index_mark.h).
  const char* no_index = "this device has no counter and detects no reference mark";
};
const std::vector<DriverRow>& driver_rows();  // by name
const DriverRow* find_driver(const std::string& name);

// Reads the driver's keys from `table` (the caller has read `driver` and `name`) and finishes the
// table. Errors name file, line and key; the error of an unknown driver lists the known drivers.
Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context);

}  // namespace mdof::drivers
