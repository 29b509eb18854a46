// A simulated machine that several simulated devices measure. All of them measure the same motion.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_wiring.h"
#include "drivers/simulator/machine.h"
#include "schema/rig/rig.h"

namespace mdof::simulate {

// Thread-bound, because one thread serves all devices.
class SensedMachine {
 public:
  SensedMachine(const Rig& rig, drivers::SimulatorOptions options, drivers::ForwardModel model);

  // Raw value of a channel before the calibration of the rig, µm. The noise depends on the time in
  // whole microseconds: two devices that read at different times get different noise.
  double raw_um(std::size_t channel, std::int64_t t_ns);
  std::size_t channel_of(const std::string& id) const;  // SIZE_MAX: no such channel.

 private:
  drivers::Machine machine_;
  std::vector<Channel> channels_;
  SampleBlock scan_;
  std::int64_t at_ns_ = -1;
};

// The function with which a simulated device with these inputs gets its readings.
drivers::Senses senses(std::shared_ptr<SensedMachine> machine,
                       std::vector<drivers::SensedInput> inputs);

}  // namespace mdof::simulate
