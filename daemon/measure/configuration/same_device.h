// `same_as` declares that an axis also uses a device of an [[axis]] above it. Example: one fixture
// with probes is moved from axis to axis, but each axis has its own encoder.
//
//   [axis.device]
//   same_as = "t7"
//   channel = [{ id = "encoder", input = "DIO2", um_per_count = 0.5 }]
//
// The channels in this table belong to this axis alone. The other probes of the rig of this axis
// have the same channels as in the axis above.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "drivers/channels.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// The tables of one [[axis]] before the devices are read.
struct AxisTables {
  TomlTable table;
  Rig rig;
  std::vector<TomlTable> devices;
};

bool is_same_as(TomlTable& device);

// The axes in `later` that also use the device `name`.
std::vector<drivers::FurtherAxis> further_axes(const std::string& name,
                                               std::vector<AxisTables>& later);

// Restricts the device to the channels of the first axis, if the device also samples channels of
// further axes. Error: the driver cannot sample the further channels, or cannot sample them at the
// same time as the channels of the first axis.
Status restrict_to_first_axis(drivers::DriverSpec& device,
                              std::vector<drivers::FurtherAxis>& further);

// Finds in `above` the device that `table` names. Returns this device with the channels of `axis`,
// and adds the delays of these channels to `axis`. Errors: the device is unknown, or cannot serve
// two axes.
Result<drivers::DriverSpec> read_same_as(TomlTable& table, const std::vector<AxisConfig>& above,
                                         double settle_s, AxisConfig& axis);

}  // namespace mdof::daemon
