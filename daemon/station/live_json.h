// JSON of the live state: devices and the newest instant.
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
// One device as in device.list, without its axis. "rate_hz": the stated rate, otherwise the
// measured one, or null if unknown.
std::string device_json(const DeviceStatus& status);
// An array of devices.
std::string devices_json(const std::vector<DeviceStatus>& devices);

struct LiveState {
  bool simulated = false;
  bool stale = false;    // no newer instant within the stale time: no value is shown as good
  std::int64_t run = 0;  // 0: none
  std::vector<std::string> trouble = {};  // present troubles of the axis' devices
};

// The value of live.update: {"axis", "time_ns", "encoder_mm", "still", "simulated", "stale",
// "waiting_for", "probes": [{"id", "um", "low_um", "high_um", "quality", "range_um"}], "errors":
// {...} | null, "run": id | null, "trouble": [...]}. Errors are null while stale. low_um and
// high_um are the extremes of the last second, so that a spike between two updates is visible.
std::string live_json(const Rig& rig, const Pipeline& pipeline, const RecentRange& recent,
                      const LiveState& state);

}  // namespace mdof::daemon
