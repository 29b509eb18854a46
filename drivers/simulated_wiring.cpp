#include "drivers/simulated_wiring.h"

#include "schema/sample.h"

namespace mdof::drivers {

SensedInput SimulatedWiring::volt(const std::string& channel) {
  if (channel.empty()) return {};
  const auto um_per_V = um_per_V_of(channel);
  if (!um_per_V)
    table_.reject("inputs", "\"" + channel + "\" of " + rig_.source +
                                " needs um_per_V, because its input gives volts");
  return {channel, 1 / um_per_V.value_or(1), 0};
}

std::optional<double> SimulatedWiring::um_per_V_of(const std::string& channel) const {
  if (channel == kEncoderChannel) return rig_.encoder_um_per_V;
  const auto probe = rig_.probe_index(channel);
  return probe ? rig_.probes[*probe].calibration.um_per_V : std::nullopt;
}

SensedInput SimulatedWiring::counts(const std::string& channel) {
  if (um_per_count_ == 0) um_per_count_ = table_.number("um_per_count", 0.05);
  if (um_per_count_ == 0) table_.reject("um_per_count", "must not be zero");
  return {channel, 1 / um_per_count_, 0};
}

std::vector<SensedInput> SimulatedWiring::volts() {
  std::vector<SensedInput> sensed;
  for (const std::string& channel : inputs_) sensed.push_back(volt(channel));
  return sensed;
}

std::string SimulatedWiring::first_or_encoder() const {
  return inputs_.empty() ? kEncoderChannel : inputs_[0];
}

}  // namespace mdof::drivers
