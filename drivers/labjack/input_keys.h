// Channel keys that LabJack devices share: differential inputs and counters.
#pragma once

#include <string>
#include <vector>

#include "drivers/channels.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::labjack {

// In addition to the keys that all drivers have.
struct InputKeys {
  double most_counts_per_s = 0, range_v = 0;  // 0: not given
  std::string negative;
};
InputKeys read_input_keys(TomlTable& channel);

// Index of `range_v` in "10, 1, 0.1, 0.01"; -1: not one of them.
int range_of(double range_v);
inline constexpr const char* kRangesText = "must be 10, 1, 0.1 or 0.01";

// The negative input of the even input `ain`: the next input. Other pairs are impossible.
Result<int> negative_of(const std::string& device, const ChannelInput& channel, int ain,
                        const std::string& negative);

struct InputUse {
  int ain = -1;       // -1: a counter
  int negative = -1;  // -1: single-ended
};
// Errors: the negative input of one channel is a channel itself; a second counter of one axis.
Status check_uses(const std::vector<ChannelInput>& channels, const std::vector<InputUse>& uses);

}  // namespace mdof::drivers::labjack
