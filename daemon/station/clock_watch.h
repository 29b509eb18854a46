// Detects that the UTC clock of the computer was set. Measurements use the monotonic clock, so they
// are not affected. mdofd reports the change, because displayed times jump.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

namespace mdof::daemon {

// This class reads no clocks. The caller reads the UTC clock and the clock since boot at the same
// moment.
class ClockWatch {
 public:
  // The step of the UTC clock since the previous call, ns. nullopt if the step is 50 ms or less:
  // time synchronisation makes such small changes.
  std::optional<std::int64_t> look(std::int64_t utc_ns, std::int64_t boot_ns) {
    const std::int64_t offset = utc_ns - boot_ns;
    const std::int64_t step = offset - std::exchange(offset_ns_, offset).value_or(offset);
    return std::abs(step) > kStep_ns ? std::optional(step) : std::nullopt;
  }

 private:
  static constexpr std::int64_t kStep_ns = 50'000'000;
  std::optional<std::int64_t> offset_ns_;
};

}  // namespace mdof::daemon
