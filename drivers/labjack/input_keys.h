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

struct InputUse {
  int ain = -1;       // -1: a counter
  int negative = -1;  // -1: single-ended
  int counter = -1;   // index of the counter; -1: an AIN
};
// Returns the input that the channel names. `device`: "T7", for messages; `ains`: number of
// analogue inputs. Errors: the device has no such input; a key does not apply to this kind of
// input; the negative input of a differential input is not the next input of an even AIN (the
// device has no other pairs).
Result<InputUse> input_use(const std::string& device, const ChannelInput& channel,
                           const InputKeys& keys, int ains,
                           const std::vector<std::string>& counters);
// Errors: the negative input of one channel is also the input of another channel; one axis has two
// counters.
Status check_uses(const std::vector<ChannelInput>& channels, const std::vector<InputUse>& uses);

}  // namespace mdof::drivers::labjack
