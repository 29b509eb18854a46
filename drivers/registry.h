// All drivers with their names in the configuration. Each driver has one row in registry.cpp.
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

// The simulated twin of a device. The device kind in mdof-simulate has the same name as the driver.
struct SimulatedKind {
  std::size_t most_inputs;
  const char* inputs;   // for users: "up to 14 probes, in volts, and the encoder"
  const char* reached;  // how a program connects to the simulated device: "TCP: command, stream"
  MakeSimulated make;
};

// All facts about a driver that other folders need.
struct DriverRow {
  const char* name;     // name in the configuration
  const char* folder;   // folder in drivers/
  const char* devices;  // one line of text: the devices and their connection
  Result<DriverSpec> (*configure)(TomlTable&, const DriverContext&);
  // nullopt: the device is in the network, or it is a file or a script.
  std::optional<LinuxNode> node = std::nullopt;
  std::optional<SimulatedKind> simulated = std::nullopt;  // nullopt: no twin (README.md)
  // Reason why the key `index_mm` of an encoder is rejected; nullptr: the key is allowed, because
  // the driver reliably detects that the axis passes the mark (counter/index_mark.h).
  const char* no_index = "this device has no counter and detects no reference mark";
};
const std::vector<DriverRow>& driver_rows();  // sorted by name
const DriverRow* find_driver(const std::string& name);

// Reads the driver's keys from `table`; the caller has read `driver` and `name` before. Rejects
// unknown keys in the table. Errors name file, line and key; the error for an unknown driver lists
// all drivers.
Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context);

}  // namespace mdof::drivers
