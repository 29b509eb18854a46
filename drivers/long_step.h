// A driver may take long over a step, as to ask a slow slave for all its registers. It then says by
// when the step will have ended, so that the watch on its thread does not take the thread for hung.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace mdof::drivers {

using LongStepWatcher = std::function<void(std::chrono::steady_clock::time_point until)>;

// Of the calling thread; empty: nobody watches.
inline LongStepWatcher& long_step_watcher() {
  thread_local LongStepWatcher watcher;
  return watcher;
}

// The next step ends at the latest after `duration`.
inline void expect_long_step(std::chrono::steady_clock::duration duration) {
  if (const auto& watcher = long_step_watcher())
    watcher(std::chrono::steady_clock::now() + duration);
}

}  // namespace mdof::drivers
