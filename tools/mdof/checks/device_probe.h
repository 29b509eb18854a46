// Opens a device, reads from it, and reports the readings of its channels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drivers/driver_spec.h"
#include "schema/base/result.h"

namespace mdof::tools {

struct ChannelFinding {
  std::string id, unit;
  double mean = 0, sd = 0, low = 0, high = 0;  // of the usable values, in `unit`
  std::uint64_t values = 0, unusable = 0;      // Unusable: over range, missing or suspect.
  std::string worst;                           // Name of the worst quality among all values.
};

struct DeviceFinding {
  std::string name, driver, description, error;
  // The scan rate that the device states (NaN: none), and the measured scan rate.
  double stated_rate_hz = kNaN, rate_hz = 0;
  std::uint64_t scans = 0, lost = 0;
  std::vector<ChannelFinding> channels;
  std::optional<drivers::ClockState> clock;
};

using StopRequested = std::function<bool()>;

// Reads for `for_s` seconds, or until stop() returns true. If this fails, the message is in
// DeviceFinding::error.
DeviceFinding probe_device(const drivers::DriverSpec& device, double for_s,
                           const StopRequested& stop);
std::string finding_text(const DeviceFinding& finding);
std::string finding_json(const DeviceFinding& finding);

// Prints the newest scan to the standard output ten times a second, until stop() returns true or an
// error occurs.
Status monitor_device(const drivers::DriverSpec& device, const StopRequested& stop);

}  // namespace mdof::tools
