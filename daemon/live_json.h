// JSON of what is seen while it happens: devices and the newest instant.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/pipeline.h"
#include "daemon/station.h"
#include "schema/rig.h"

namespace mdof::daemon {

// One device as device.list gives it, without its axis.
std::string device_json(const DeviceStatus& status);

// The value of live.update: {"axis", "time_ns", "encoder_mm", "still", "simulated", "waiting_for",
// "probes": [{"id", "um", "quality", "range_um"}], "errors": {...} | null, "run": id | null}.
std::string live_json(const Rig& rig, const Pipeline& pipeline, bool simulated, std::int64_t run);

}  // namespace mdof::daemon
