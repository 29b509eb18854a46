// Counts the scans that a device would have taken while its driver was closed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mdof::drivers {

class LossWhileClosed {
 public:
  void close() { was_closed_ = last_ns_ != 0; }
  // Takes the time of each returned scan. Returns the number of lost scans before the first scan
  // after close(), otherwise 0.
  std::uint64_t take(std::int64_t time_ns, double rate_hz) {
    const std::int64_t last_ns = std::exchange(last_ns_, time_ns);
    if (!std::exchange(was_closed_, false)) return 0;
    const double scans = static_cast<double>(time_ns - last_ns) * 1e-9 * rate_hz;
    return static_cast<std::uint64_t>(std::max(0.0, std::round(scans) - 1));
  }

 private:
  std::int64_t last_ns_ = 0;  // time of the last returned scan
  bool was_closed_ = false;   // since the last returned scan
};

}  // namespace mdof::drivers
