// Connects a simulated device to the simulated machine: the channels of the rig at the inputs of
// the device, and the keys of the device in a plan of mdof-simulate.
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

// The signal of a rig's channel at an input of the device.
struct SensedInput {
  std::string channel;  // of the rig, or "encoder"; "": not connected
  double per_unit = 1;  // input = raw µm (encoder: µm of travel) * per_unit + offset
  double offset = 0;    // µm/V become V with per_unit = 1 / um_per_V
};

// Thread-bound. Errors in the plan are rejected at their keys. The caller finishes table().
class SimulatedWiring {
 public:
  // Makes the signals of the machine at these inputs.
  using Machine = std::function<Senses(std::vector<SensedInput>)>;

  // `folder`: folder of the plan. `inputs`: a channel of the rig, "encoder" or "" for each input 0,
  // 1 ... All arguments must outlive the object.
  SimulatedWiring(const Rig& rig, const std::filesystem::path& folder, const Machine& machine,
                  const std::vector<std::string>& inputs, TomlTable& table)
      : rig_(rig), folder_(folder), machine_(machine), inputs_(inputs), table_(table) {}

  const Rig& rig() const { return rig_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  TomlTable& table() { return table_; }

  SensedInput um(const std::string& channel) const { return {channel, 1, 0}; }
  // As volts behind an amplifier, by the rig's calibration.
  SensedInput volt(const std::string& channel);
  // As counts of the encoder's counter; reads the key um_per_count.
  SensedInput counts(const std::string& channel);
  // All inputs as volts.
  std::vector<SensedInput> volts();
  // The channel at the first input; the encoder if the plan lists no inputs.
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

// Makes the simulated device of a driver from the device's keys. Errors name file, line and key.
using MakeSimulated = Result<std::unique_ptr<SimulatedDevice>> (*)(SimulatedWiring& wiring);

}  // namespace mdof::drivers
