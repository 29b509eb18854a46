// Opens a device and finds out what it says.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drivers/driver_spec.h"
#include "schema/base/result.h"

namespace mdof::tools {

struct ChannelFinding {
  std::string id, unit;
  double mean = 0, sd = 0, low = 0, high = 0;  // of the usable values, in the unit
  std::uint64_t values = 0, unusable = 0;      // over-range, missing, suspect ...
  std::string worst;                           // quality seen
};

struct DeviceFinding {
  std::string name, driver, description, error;
  // Scans a second, as it says (NaN: it does not) and as they came.
  double stated_rate_hz = kNaN, rate_hz = 0;
  std::uint64_t scans = 0, lost = 0;
  std::vector<ChannelFinding> channels;
  std::optional<drivers::ClockState> clock;
};

using StopAsked = std::function<bool()>;

// Reads for `for_s` seconds, or until asked to stop. A failure is in `error`.
DeviceFinding probe_device(const drivers::DriverSpec& device, double for_s, const StopAsked& stop);
std::string finding_text(const DeviceFinding& finding);
std::string finding_json(const DeviceFinding& finding);

// The newest scan ten times a second on the standard output, until asked to stop or an error.
Status monitor_device(const drivers::DriverSpec& device, const StopAsked& stop);

}  // namespace mdof::tools
