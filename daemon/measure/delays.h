// `delay_us` of a rig's probes (their amplifiers' filters) and of a device's channels (its filter,
// their place in a scan): what readings come later than their time stamps say, and what of it
// alignment takes out. A probe that has both has their sum.
#pragma once

#include <map>
#include <string>

#include "daemon/measure/pipeline.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

using ChannelDelays = std::map<std::string, double>;  // s, by id; absent: 0

// Adds those of a device's `channel` tables. Rejects one that is negative, not finite or longer
// than `settle_s`, as a stop would then begin with readings of the way to it; and one of no channel
// of the rig.
void read_delays(TomlTable& device, const Rig& rig, double settle_s, ChannelDelays& delays);

// Frames are on the encoder's time line: each probe is taken earlier by what it comes later than
// the encoder. A late reading contains motion from after its instant: so much is left out at
// the end of each stop. Delays that are all the same leave the scans as they are.
PipelineOptions with_delays(PipelineOptions options, const Rig& rig, const ChannelDelays& delays);

// For a replay: `options` with the delays of `rig` instead of those of `recorded`, which they have
// in them already (no rig: none).
PipelineOptions with_delays_of(const Rig& rig, const Rig& recorded, PipelineOptions options);

// Error: stops are given less time to settle than the channels' filters need (`leave_s` of the same
// options). Says what to set.
Status check_settling(const PipelineOptions& options);

}  // namespace mdof::daemon
