#include "drivers/labjack/input_keys.h"

#include <array>
#include <map>
#include <optional>

#include "drivers/labjack/count_guard.h"

namespace mdof::drivers::labjack {

InputKeys read_input_keys(TomlTable& channel) {
  InputKeys keys;
  keys.most_counts_per_s = read_most_counts_per_s(channel);
  keys.negative = channel.string("negative", "");
  if (!channel.has("range_v")) return keys;
  keys.range_v = channel.number("range_v", 0);
  if (range_of(keys.range_v) < 0) channel.reject("range_v", kRangesText);
  return keys;
}

int range_of(double range_v) {
  constexpr std::array kAll_v = {10.0, 1.0, 0.1, 0.01};
  for (std::size_t i = 0; i < kAll_v.size(); ++i)
    if (range_v == kAll_v[i]) return static_cast<int>(i);
  return -1;
}

Result<int> negative_of(const std::string& device, const ChannelInput& channel, int ain,
                        const std::string& negative) {
  const std::string partner = "AIN" + std::to_string(ain + 1);
  if (ain % 2 == 0 && negative == partner) return ain + 1;
  return bad_input(
      channel.where + ": negative = \"" + negative + "\" is not possible; a " + device +
      " can only measure the voltage between an even AIN and the next AIN; give " +
      (ain % 2 == 0 ? "negative = \"" + partner + "\" with " + channel.input
                    : "negative = \"" + channel.input + "\" with AIN" + std::to_string(ain - 1)));
}

Status check_uses(const std::vector<ChannelInput>& channels, const std::vector<InputUse>& uses) {
  std::map<std::optional<Axis>, std::string> counters;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i].ain < 0) {
      const auto [other, fresh] = counters.emplace(channels[i].further, channels[i].input);
      if (!fresh)
        return bad_input(
            channels[i].where + ": \"" + channels[i].id +
            "\" is a second counter of this axis (the first is " + other->second +
            "), but an axis can use only one counter of a device. Connect \"" + channels[i].id +
            "\" to another device. Or, if this is the encoder of another axis, declare "
            "this encoder in [axis.device] of that axis, with the key \"same_as\"");
    }
    for (std::size_t other = 0; other < uses.size(); ++other)
      if (uses[i].ain >= 0 && uses[other].negative == uses[i].ain)
        return bad_input(channels[i].where + ": " + channels[i].input +
                         " is the negative input of \"" + channels[other].id +
                         "\", so this input cannot be a separate channel; use another input");
  }
  return {};
}

}  // namespace mdof::drivers::labjack
