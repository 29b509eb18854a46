// Keys of a channel that all LabJack devices have: differential inputs and counters.
#pragma once

#include <string>
#include <vector>

#include "drivers/channels.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::labjack {

// These keys extend the keys that the channels of all drivers have.
struct InputKeys {
  double most_counts_per_s = 0, range_v = 0;  // 0: not given
  std::string negative;
};
InputKeys read_input_keys(TomlTable& channel);

// Index of `range_v` in the list 10, 1, 0.1, 0.01; -1: the list does not contain it.
int range_of(double range_v);
inline constexpr const char* kRangesText = "must be 10, 1, 0.1 or 0.01";

// Returns the negative input of a differential input. The number `ain` must be even, and the
// negative input must be the next input; the device has no other pairs.
Result<int> negative_of(const std::string& device, const ChannelInput& channel, int ain,
                        const std::string& negative);

struct InputUse {
  int ain = -1;       // -1: a counter
  int negative = -1;  // -1: single-ended
};
// Errors: the negative input of one channel is also the input of another channel; one axis has two
// counters.
Status check_uses(const std::vector<ChannelInput>& channels, const std::vector<InputUse>& uses);

}  // namespace mdof::drivers::labjack
