// The clock of the simulator; tests replace it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "drivers/clock/monotonic.h"

namespace mdof::drivers {

struct Clock {
  std::function<std::int64_t()> now_ns;            // time of a monotonic clock
  std::function<void(std::int64_t ns)> sleep_for;  // sleeps at least this duration
};

inline Clock steady_clock() {
  using std::chrono::nanoseconds;
  return {monotonic_ns, [](std::int64_t ns) { std::this_thread::sleep_for(nanoseconds(ns)); }};
}

}  // namespace mdof::drivers
