// Connects a simulated device to the simulated machine. Assigns channels of the rig to the inputs
// of the device, and reads the keys of the device from a plan of mdof-simulate.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::drivers {

// The signal of a channel of the rig at an input of the device.
struct SensedInput {
  std::string channel;  // id of a probe in the rig, or "encoder"; "": not connected
  double per_unit = 1;  // input = µm * per_unit + offset; µm: raw reading, or travel at the encoder
  double offset = 0;    // in the unit of the input; for an input in V, per_unit is 1 / um_per_V
};

// Thread-bound. Errors in the plan are reported with their keys. The caller finishes table().
class SimulatedWiring {
 public:
  // Returns the signals of the machine for these inputs.
  using Machine = std::function<Senses(std::vector<SensedInput>)>;

  // `folder`: folder of the plan. `inputs`: for each input 0, 1 ... the id of a probe in the rig,
  // "encoder" or "". The arguments must exist longer than the object.
  SimulatedWiring(const Rig& rig, const std::filesystem::path& folder, const Machine& machine,
                  const std::vector<std::string>& inputs, TomlTable& table)
      : rig_(rig), folder_(folder), machine_(machine), inputs_(inputs), table_(table) {}

  const Rig& rig() const { return rig_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  TomlTable& table() { return table_; }

  SensedInput um(const std::string& channel) const { return {channel, 1, 0}; }
  // The input in V after an amplifier; the calibration in the rig gives µm/V.
  SensedInput volt(const std::string& channel);
  // The input in counts of the encoder; reads the key um_per_count.
  SensedInput counts(const std::string& channel);
  // All inputs, in V.
  std::vector<SensedInput> volts();
  // The channel at the first input, or "encoder" if the plan lists no inputs.
  std::string first_or_encoder() const;

  Senses senses(std::vector<SensedInput> inputs) const { return machine_(std::move(inputs)); }

 private:
  std::optional<double> um_per_V_of(const std::string& channel) const;

  const Rig& rig_;
  const std::filesystem::path& folder_;
  const Machine& machine_;
  const std::vector<std::string>& inputs_;
  TomlTable& table_;
  double um_per_count_ = 0;
};

// Makes the simulated device of a driver from the keys of the device. Errors name file, line and
// key.
using MakeSimulated = Result<std::unique_ptr<SimulatedDevice>> (*)(SimulatedWiring& wiring);

}  // namespace mdof::drivers
