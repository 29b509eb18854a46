// Keys of a channel that LabJack's devices share: differential inputs, and counters.
#pragma once

#include <string>
#include <vector>

#include "drivers/channels.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::labjack {

// Besides those of every family's channels.
struct InputKeys {
  double most_counts_per_s = 0, range_v = 0;  // 0: not given
  std::string negative;
};
InputKeys read_input_keys(TomlTable& channel);

// Of "10, 1, 0.1 or 0.01" the index; -1: none of them.
int range_of(double range_v);
inline constexpr const char* kRangesText = "must be 10, 1, 0.1 or 0.01";

// LabJack's pairs: the even input `ain` against the one after it.
Result<int> negative_of(const std::string& device, const ChannelInput& channel, int ain,
                        const std::string& negative);

struct InputUse {
  int ain = -1;       // -1: it counts
  int negative = -1;  // -1: single-ended
};
// Errors: what one input is measured against is an input of its own; a second counter of
// one axis.
Status check_uses(const std::vector<ChannelInput>& channels, const std::vector<InputUse>& uses);

}  // namespace mdof::drivers::labjack
