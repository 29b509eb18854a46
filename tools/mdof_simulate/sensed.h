// A simulated machine as the inputs of several devices sense it: one truth, whoever asks.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_wiring.h"
#include "drivers/simulator/machine.h"
#include "schema/rig/rig.h"

namespace mdof::simulate {

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

// What a device with these inputs senses of the machine.
drivers::Senses senses(std::shared_ptr<SensedMachine> machine,
                       std::vector<drivers::SensedInput> inputs);

}  // namespace mdof::simulate
