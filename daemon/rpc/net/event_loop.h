// The event loop of the main thread. It waits for descriptors, timers, signals and work from other
// threads, and runs their functions one after the other on the thread that called run().
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "daemon/rpc/session/executor.h"

namespace mdof::rpc {

class EventLoop {
 public:
  struct Core;  // contains the Asio objects; see event_loop_core.h

  EventLoop();
  // Destroy the loop after run() has returned. Queued work is destroyed without being run.
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  // Runs functions, and waits if there is none to run, until stop() is called.
  void run();
  // Thread-safe. Makes run() return; a function that runs now is finished first.
  void stop();
  // Thread-safe. Functions from one thread run in the order in which this thread posted them. Does
  // nothing after the loop has been destroyed.
  void post(std::function<void()> work);
  // Call call_every() before run() or on the loop. Calls `work` at multiples of `period`; missed
  // calls are skipped.
  void call_every(std::chrono::nanoseconds period, std::function<void()> work);
  // Call on_signal() before run() or on the loop. Calls `work(number)` on the loop for each of
  // these signals.
  void on_signal(const std::vector<int>& signals, std::function<void(int)> work);
  // Call on_readable() before run() or on the loop. Calls `work` whenever the descriptor is
  // readable; `work` must read the data. The descriptor belongs to the caller, who must not close
  // it before run() returns.
  void on_readable(int descriptor, std::function<void()> work);

  const std::shared_ptr<Core>& core() const { return core_; }
  std::shared_ptr<Executor> executor() const;  // for code that does not depend on EventLoop

 private:
  // Shared with objects that may post after the loop has been destroyed.
  std::shared_ptr<Core> core_;
};

}  // namespace mdof::rpc
