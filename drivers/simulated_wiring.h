// How a simulated device is wired to the simulated machine: the channels of a rig at its inputs,
// and the keys of its own, as a plan of mdof-simulate has them.
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

// What a channel of the rig looks like at a device's input.
struct SensedInput {
  std::string channel;  // of the rig, or "encoder"; "": nothing is connected
  double per_unit = 1;  // input = raw µm (of the encoder: µm of travel) * per_unit + offset
  double offset = 0;    // µm/V become V with per_unit = 1 / um_per_V
};

// Thread-bound. What is wrong in the plan is rejected by its key; the caller finishes table().
class SimulatedWiring {
 public:
  // What a device senses of the machine at such inputs.
  using Machine = std::function<Senses(std::vector<SensedInput>)>;

  // `folder`: of the plan. `inputs`: channels of the rig, "encoder" or "", at the inputs 0, 1 ...
  // All are to live longer.
  SimulatedWiring(const Rig& rig, const std::filesystem::path& folder, const Machine& machine,
                  const std::vector<std::string>& inputs, TomlTable& table)
      : rig_(rig), folder_(folder), machine_(machine), inputs_(inputs), table_(table) {}

  const Rig& rig() const { return rig_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  TomlTable& table() { return table_; }

  SensedInput um(const std::string& channel) const { return {channel, 1, 0}; }
  // Behind an amplifier, as the rig's calibration has it.
  SensedInput volt(const std::string& channel);
  // As a counter of the encoder counts it: key um_per_count.
  SensedInput counts(const std::string& channel);
  // All inputs as volts.
  std::vector<SensedInput> volts();
  // The channel at the first input; the encoder where none is given.
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

// Makes the simulated device of a family from its own keys. Errors name file, line and key.
using MakeSimulated = Result<std::unique_ptr<SimulatedDevice>> (*)(SimulatedWiring& wiring);

}  // namespace mdof::drivers
