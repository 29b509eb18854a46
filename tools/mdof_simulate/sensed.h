// A simulated machine as the inputs of several devices sense it: one truth, whoever asks.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "drivers/simulator/machine.h"
#include "schema/rig/rig.h"

namespace mdof::simulate {

// What a channel of the rig looks like at a device's input.
struct Input {
  std::string channel;  // of the rig, or "encoder"; "": nothing is connected
  double per_unit = 1;  // input = raw µm (of the encoder: µm of travel) * per_unit + offset
  double offset = 0;    // µm/V become V with per_unit = 1 / um_per_V
};

// Thread-bound, as all devices are served by one thread.
class SensedMachine {
 public:
  SensedMachine(const Rig& rig, drivers::SimulatorOptions options, drivers::ForwardModel model);

  // Raw value of a channel as the rig's calibration expects it, in µm. Noise depends on the
  // microsecond, so that two devices that ask at different times see different noise.
  double raw_um(std::size_t channel, std::int64_t t_ns);
  std::size_t channel_of(const std::string& id) const;  // SIZE_MAX: none

 private:
  drivers::Machine machine_;
  std::vector<Channel> channels_;
  SampleBlock scan_;
  std::int64_t at_ns_ = -1;
};

// `ppm`: the device's clock is fast by so much; its times are turned into those of the machine.
drivers::Senses senses(std::shared_ptr<SensedMachine> machine, std::vector<Input> inputs);

}  // namespace mdof::simulate
