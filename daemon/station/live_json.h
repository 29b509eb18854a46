// JSON of what is seen while it happens: devices and the newest instant.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/measure/pipeline.h"
#include "daemon/station/recent_range.h"
#include "daemon/station/station.h"
#include "schema/base/json_writer.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// {"drift_ppm", "jitter_ms", "settled", "steps"}, or null.
void write_clock(JsonWriter& json, const std::optional<drivers::ClockState>& clock);
// One device as device.list gives it, without its axis. "rate_hz": as the device states it, else as
// measured, null where not known yet.
std::string device_json(const DeviceStatus& status);
// An array of them.
std::string devices_json(const std::vector<DeviceStatus>& devices);

struct LiveState {
  bool simulated = false;
  bool stale = false;    // nothing newer has come for the stated age: no value is shown as good
  std::int64_t run = 0;  // 0: none
  std::vector<std::string> trouble = {};  // of the axis' devices, as it stands
};

// The value of live.update: {"axis", "time_ns", "encoder_mm", "still", "simulated", "stale",
// "waiting_for", "probes": [{"id", "um", "low_um", "high_um", "quality", "range_um"}],
// "errors": {...} | null, "run": id | null, "trouble": [...]}. Errors are null while stale; low_um
// and high_um are those of the last second, so that a spike between two updates is seen.
std::string live_json(const Rig& rig, const Pipeline& pipeline, const RecentRange& recent,
                      const LiveState& state);

}  // namespace mdof::daemon
