// The loop that the daemon's main owns: readiness of descriptors, timers, signals and work posted
// from other threads, one after the other on the thread that called run().
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
  struct Core;  // of Asio; see event_loop_core.h

  EventLoop();
  // After run() has returned. Work that is still queued is destroyed, not run.
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  // Runs until stop(); never returns for want of work.
  void run();
  // Thread-safe. What is running ends first.
  void stop();
  // Thread-safe. In order for one posting thread; after the loop's end nothing happens.
  void post(std::function<void()> work);
  // Before run() or on the loop: every `period`, on a fixed grid; missed ticks are left out.
  void call_every(std::chrono::nanoseconds period, std::function<void()> work);
  // Before run() or on the loop: calls `work(number)` on the loop for each of these signals.
  void on_signal(const std::vector<int>& signals, std::function<void(int)> work);
  // Before run() or on the loop: calls `work` whenever there is something to read, which it takes.
  // The descriptor stays the caller's and must outlive the loop's run().
  void on_readable(int descriptor, std::function<void()> work);

  const std::shared_ptr<Core>& core() const { return core_; }
  std::shared_ptr<Executor> executor() const;  // this loop, for those who know no loops

 private:
  std::shared_ptr<Core> core_;  // shared with those who may post after the loop has gone
};

}  // namespace mdof::rpc
