// Detects changes of the time of day. Measurements have monotonic times and are not affected, but
// the displayed times jump, so the change is reported.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

namespace mdof::daemon {

// Pure: the caller reads both clocks at the same moment.
class ClockWatch {
 public:
  // The change of the time of day since the previous call; nullopt if it was not set. Slower
  // changes are normal clock discipline.
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
