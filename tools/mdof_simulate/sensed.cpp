#include "tools/mdof_simulate/sensed.h"

#include <algorithm>

namespace mdof::simulate {

SensedMachine::SensedMachine(const Rig& rig, drivers::SimulatorOptions options,
                             drivers::ForwardModel model)
    : machine_(rig, std::move(options), std::move(model)), channels_(machine_.channels()) {
  scan_.value.resize(channels_.size());
  scan_.quality.resize(channels_.size());
}

std::size_t SensedMachine::channel_of(const std::string& id) const {
  const auto found = std::find_if(channels_.begin(), channels_.end(),
                                  [&](const Channel& c) { return c.id == id; });
  return found == channels_.end() ? SIZE_MAX : static_cast<std::size_t>(found - channels_.begin());
}

double SensedMachine::raw_um(std::size_t channel, std::int64_t t_ns) {
  if (t_ns != at_ns_) {
    for (auto& column : scan_.value) column.clear();
    for (auto& column : scan_.quality) column.clear();
    machine_.append_scan(scan_, static_cast<std::uint64_t>(t_ns / 1000), t_ns);
    at_ns_ = t_ns;
  }
  return scan_.value[channel].back() * (channels_[channel].unit == Unit::mm ? 1e3 : 1);
}

drivers::Senses senses(std::shared_ptr<SensedMachine> machine,
                       std::vector<drivers::SensedInput> inputs) {
  std::vector<std::size_t> channels;
  for (const drivers::SensedInput& input : inputs)
    channels.push_back(machine->channel_of(input.channel));
  return [machine = std::move(machine), inputs = std::move(inputs), channels = std::move(channels)](
             std::size_t input, std::int64_t t_ns) {
    if (input >= inputs.size() || channels[input] == SIZE_MAX) return 0.0;
    return machine->raw_um(channels[input], t_ns) * inputs[input].per_unit + inputs[input].offset;
  };
}

}  // namespace mdof::simulate
