// Times of the clock that all samples use.
#pragma once

#include <chrono>
#include <cstdint>

namespace mdof::drivers {

inline std::int64_t to_ns(std::chrono::steady_clock::time_point time) {
  const auto since = time.time_since_epoch();
  return std::int64_t{std::chrono::duration_cast<std::chrono::nanoseconds>(since).count()};
}

inline std::int64_t monotonic_ns() {
  return to_ns(std::chrono::steady_clock::now());
}

}  // namespace mdof::drivers
