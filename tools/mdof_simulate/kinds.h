// The kinds of simulated devices, each connected to the simulated machine.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"
#include "tools/mdof_simulate/sensed.h"

namespace mdof::simulate {

struct Wiring {
  Rig rig;
  std::shared_ptr<SensedMachine> machine;
  std::filesystem::path folder;  // Folder of the plan.
};

// Creates a device of this kind from the keys of the kind in `table`. `inputs`: for each input of
// the device, the channel of the rig that it measures, or "" for none. Errors name file, line and
// key.
Result<std::unique_ptr<drivers::SimulatedDevice>> make_device(
    const std::string& kind, const Wiring& wiring, const std::vector<std::string>& inputs,
    TomlTable& table);

}  // namespace mdof::simulate
