// Writes the live state as JSON: the devices, and the newest readings.
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

// Writes {"drift_ppm", "jitter_ms", "settled", "steps"}, or null without a clock.
void write_clock(JsonWriter& json, const std::optional<drivers::ClockState>& clock);
// One device as in the reply of device.list, without the member "axis". "rate_hz" is the rate that
// the device states. If the device states no rate, "rate_hz" is the measured rate, or null if this
// rate is unknown.
std::string device_json(const DeviceStatus& status);
// An array of devices.
std::string devices_json(const std::vector<DeviceStatus>& devices);

struct LiveState {
  bool simulated = false;
  // The newest readings are older than stale_s, so no reading has the quality "good".
  bool stale = false;
  double age_s = 0;                       // age of the newest readings
  std::int64_t run = 0;                   // 0: no run
  std::vector<std::string> trouble = {};  // current troubles of the devices of the axis
};

// The value of the topic live.update:
//   {"axis", "time_ns", "encoder_mm", "encoder_quality", "still", "simulated", "stale", "age_s",
//    "waiting_for", "probes": [{"id", "um", "low_um", "high_um", "quality", "range_um"}],
//    "reference", "errors": {...} | null, "run": id | null, "trouble": [...]}
// "still" is null if the position is unknown. "errors" is null if the readings are stale. low_um
// and high_um are the smallest and the largest reading of the last second, so that a spike between
// two messages is visible.
std::string live_json(const Rig& rig, const Pipeline& pipeline, const RecentRange& recent,
                      const LiveState& state);

}  // namespace mdof::daemon
