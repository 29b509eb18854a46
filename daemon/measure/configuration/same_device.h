// `same_as` declares that an axis also uses a device of an [[axis]] above it. One fixture with its
// probes moves from axis to axis, but each axis has its own encoder.
//
//   [axis.device]
//   same_as = "t7"
//   channel = [{ id = "encoder", input = "DIO2", um_per_count = 0.5 }]
//
// Channels that the table gives belong to this axis alone. The other probes of its rig have the
// same channels as in the axis above.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "drivers/channels.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// One [[axis]] of a configuration whose devices are not yet read.
struct AxisTables {
  TomlTable table;
  Rig rig;
  std::vector<TomlTable> devices;
};

bool is_same_as(TomlTable& device);

// The later axes that also use the device `name`.
std::vector<drivers::FurtherAxis> further_axes(const std::string& name,
                                               std::vector<AxisTables>& later);

// Restricts the device to the channels of its first axis, if it also samples channels of further
// axes. Error: the driver cannot sample the further channels, or not at the same time.
Status restrict_to_first_axis(drivers::DriverSpec& device,
                              std::vector<drivers::FurtherAxis>& further);

// The device that `table` names, found in `above`, with the channels of `axis`. Adds the delays of
// its channels. Errors: unknown device; device that cannot serve two axes.
Result<drivers::DriverSpec> read_same_as(TomlTable& table, const std::vector<AxisConfig>& above,
                                         double settle_s, AxisConfig& axis);

}  // namespace mdof::daemon
