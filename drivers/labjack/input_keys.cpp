#include "drivers/labjack/input_keys.h"

#include <algorithm>
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

namespace {

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

Status check_counter(const ChannelInput& channel, const InputKeys& keys) {
  if (!keys.negative.empty() || keys.range_v > 0)
    return bad_input(channel.where + ": " + channel.input +
                     " is a counter; the keys \"negative\" and \"range_v\" apply to an AIN only; "
                     "remove these keys");
  return check_um_per_count(channel);
}

}  // namespace

Result<InputUse> input_use(const std::string& device, const ChannelInput& channel,
                           const InputKeys& keys, int ains,
                           const std::vector<std::string>& counters) {
  std::vector<std::string> known;
  for (int n = 0; n < ains; ++n) known.push_back("AIN" + std::to_string(n));
  known.insert(known.end(), counters.begin(), counters.end());
  const auto found = std::find(known.begin(), known.end(), channel.input);
  if (found == known.end()) return no_such_input(channel, known);
  const auto at = static_cast<int>(found - known.begin());
  if (at >= ains) {
    MDOF_CHECK(check_counter(channel, keys));
    return InputUse{.counter = at - ains};
  }
  if (channel.um_per_count != 0 || keys.most_counts_per_s > 0)
    return bad_input(channel.where + ": " + channel.input +
                     " gives volts, not counts; remove um_per_count and most_counts_per_s (the "
                     "scale is um_per_V in the rig)");
  InputUse use{.ain = at};
  if (!keys.negative.empty()) {
    MDOF_TRY(use.negative, negative_of(device, channel, at, keys.negative));
  }
  return use;
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
