// An operation of a driver may take long, for example when it reads all registers of a slow slave.
// The driver then announces the latest time at which the operation ends, so that the watchdog of
// the driver's thread does not report a hung thread.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace mdof::drivers {

using LongStepWatcher = std::function<void(std::chrono::steady_clock::time_point until)>;

// The watcher of the calling thread; empty: this thread has no watcher.
inline LongStepWatcher& long_step_watcher() {
  thread_local LongStepWatcher watcher;
  return watcher;
}

// Announces that the next operation ends at the latest after `duration`.
inline void expect_long_step(std::chrono::steady_clock::duration duration) {
  if (const auto& watcher = long_step_watcher())
    watcher(std::chrono::steady_clock::now() + duration);
}

}  // namespace mdof::drivers
