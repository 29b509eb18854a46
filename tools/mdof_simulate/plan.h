// The plan of mdof-simulate: a machine, and the devices that look at it.
//
//   rig = "rig_X.toml"           # relative to the plan
//   [machine]                    # keys of the driver "simulator"
//   [[device]]
//   name = "capa-1"
//   kind = "capancdt"            # csv_stream labjack_t7 linux_counter linux_iio modbus qsb
//   ports = [2301, 10001]        # TCP, in the order of the device's; 0 or left out: a free one
//   inputs = ["A", "B", "C"]     # channels of the rig at its inputs 1, 2, ...; "" nothing
//   # um_per_count: of an encoder; profile: modbus; rate_hz, with_time: csv_stream;
//   # sysfs_root: linux_*, a folder beside the plan; area_mm2: of the electrodes, linux_iio
//   clock_ppm = 50
//   jitter_ms = 3
#pragma once

#include <filesystem>
#include <vector>

#include "schema/result.h"
#include "tools/mdof_simulate/server.h"

namespace mdof::simulate {

// Errors name file, line and key.
Result<std::vector<Served>> load_plan(const std::filesystem::path& file);

}  // namespace mdof::simulate
