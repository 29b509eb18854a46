// Whether somebody set the time of day: what was measured has monotonic times and is not affected,
// but the times that people read jump, and that is reported.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

namespace mdof::daemon {

// Pure: time comes in from outside, both clocks read at one moment.
class ClockWatch {
 public:
  // By how much the time of day was set since the look before; nothing: it was not. Slower changes
  // are those of a clock that is being disciplined.
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
