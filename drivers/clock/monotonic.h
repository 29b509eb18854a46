// The current time of the clock that all samples use.
#pragma once

#include <chrono>
#include <cstdint>

namespace mdof::drivers {

inline std::int64_t monotonic_ns() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::int64_t{std::chrono::duration_cast<std::chrono::nanoseconds>(since).count()};
}

}  // namespace mdof::drivers
