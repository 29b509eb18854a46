// `delay_us` of the probes of a rig (filters of their amplifiers) and of the channels of a device
// (filter, place in a scan): by how much readings are later than their time stamps, and the part of
// it that alignment removes. The delays of a probe and its channel add up.
#pragma once

#include <map>
#include <string>

#include "daemon/measure/pipeline.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

using ChannelDelays = std::map<std::string, double>;  // s, by id; absent: 0

// Adds the delays of a device's `channel` tables. Rejects a delay that is negative, not finite or
// longer than `settle_s` (a stop would then begin with readings from before it), and the delay of a
// channel that the rig does not have.
void read_delays(TomlTable& device, const Rig& rig, double settle_s, ChannelDelays& delays);

// Moves each probe earlier by its delay relative to the encoder, so that frames are on the
// encoder's time line. A late reading contains motion from after its time stamp; the end of each
// stop is shortened accordingly. Equal delays do not change the scans.
PipelineOptions with_delays(PipelineOptions options, const Rig& rig, const ChannelDelays& delays);

// For a replay: replaces the delays of `recorded`, which `options` already contain, by the delays
// of `rig`. A default `recorded` has no delays.
PipelineOptions with_delays_of(const Rig& rig, const Rig& recorded, PipelineOptions options);

// Error: settle_s is shorter than the filters of the channels need (`leave_s` of the same options).
// The message states which key to set.
Status check_settling(const PipelineOptions& options);

}  // namespace mdof::daemon
