// Delays `delay_us` of readings. A delay is the time by which a reading is older than its time
// stamp. The rig states the delay of a probe (filter of the amplifier) and of the encoder. The
// configuration of a device states the delay of a channel (filter, position in the scan). The total
// delay is the sum of both delays. The aligner removes the delay of a probe relative to the
// encoder.
#pragma once

#include <map>
#include <string>

#include "daemon/measure/pipeline.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Delay in s, by channel id; a missing channel has the delay 0.
using ChannelDelays = std::map<std::string, double>;

// Adds the delays in the `channel` tables of a device. Rejects a delay that is negative, not finite
// or too large. The limit is `settle_s`: with a longer delay, the first readings of a stop would be
// from before the axis stopped. Also rejects the delay of a channel that the rig does not have.
void read_delays(TomlTable& device, const Rig& rig, double settle_s, ChannelDelays& delays);

// Shifts the readings of each probe earlier by the delay of the probe minus the delay of the
// encoder. The time of each frame is then the time of the encoder. If all delays are equal, nothing
// is shifted. Each stop ends earlier by the largest delay, because late readings contain motion
// after the stop.
PipelineOptions with_delays(PipelineOptions options, const Rig& rig, const ChannelDelays& delays);

// For a replay. Replaces the delays of the rig `recorded`, which `options` contain, by the delays
// of `rig`. A default-constructed `recorded` has no delays.
PipelineOptions with_delays_of(const Rig& rig, const Rig& recorded, PipelineOptions options);

// Error: options.dwell.settle_s is shorter than the largest delay (options.dwell.leave_s). The
// message states which key to set.
Status check_settling(const PipelineOptions& options);

}  // namespace mdof::daemon
