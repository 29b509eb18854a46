// `same_as`: a device of an [[axis]] above that this axis has, too. One fixture goes from axis to
// axis with its probes; each axis has an encoder of its own.
//
//   [axis.device]
//   same_as = "t7"
//   channel = [{ id = "encoder", input = "DIO2", um_per_count = 0.5 }]
//
// What is given is this axis' alone. What is not given, of the probes that its rig has, is as
// above.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "drivers/channels.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// The [[axis]] of a configuration before its devices are read.
struct AxisTables {
  TomlTable table;
  Rig rig;
  std::vector<TomlTable> devices;
};

bool is_same_as(TomlTable& device);

// Of the axes that come later: those that have the device `name` as well.
std::vector<drivers::FurtherAxis> further_axes(const std::string& name,
                                               std::vector<AxisTables>& later);

// Leaves to the axis of `device`, which gives channels of further axes beside its own, its part.
// Error: its driver cannot give those, or not at the same time.
Status leave_part(drivers::DriverSpec& device, std::vector<drivers::FurtherAxis>& further);

// The device that `table` names, of `above`, as `axis` has it; adds the delays of its channels.
// Errors: there is none such, or it is not one that can be had twice.
Result<drivers::DriverSpec> read_same_as(TomlTable& table, const std::vector<AxisConfig>& above,
                                         double settle_s, AxisConfig& axis);

}  // namespace mdof::daemon
