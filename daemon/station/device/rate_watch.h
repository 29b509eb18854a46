// Reports a device that sends fewer scans than its nominal rate, or loses scans.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "daemon/station/device/trouble.h"

namespace mdof::daemon {

// Thread-bound. Judges the scans of windows of 5 s.
class RateWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Begins a window. Call it when the device was opened.
  void begin(Time now);
  // Takes the number of scans since the last call. Returns whether the window has ended: then call
  // judge().
  bool take(Time now, std::uint64_t scans, std::uint64_t lost);
  // Returns the trouble that begins or ends with this window; only its kind and text are set.
  // Begins the next window. `was_slow`: the trouble "slow" was reported and has not ended. The
  // limit is then higher, so that a trouble does not begin and end repeatedly.
  std::optional<Trouble> judge(Time now, double nominal_hz, bool was_slow);

 private:
  Time end_;
  std::uint64_t scans_ = 0, lost_ = 0;  // in this window
};

}  // namespace mdof::daemon
