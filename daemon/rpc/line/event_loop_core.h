// What is behind EventLoop. Private header.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "daemon/rpc/line/asio.h"
#include "daemon/rpc/line/event_loop.h"

namespace mdof::rpc {

struct EventLoop::Core {
  std::mutex mutex;  // guards `open`, and the context against posts while it goes
  bool open = true;
  std::unique_ptr<asio::io_context> context = std::make_unique<asio::io_context>(1);

  // Thread-safe; drops the work when the loop has gone.
  template <class Work>
  void post(Work&& work) {
    const std::scoped_lock lock(mutex);
    if (open) asio::post(*context, std::forward<Work>(work));
  }

  // Thread-safe; at once when called on the loop's thread, else as post().
  template <class Work>
  void dispatch(Work&& work) {
    std::unique_lock lock(mutex);
    if (!open) return;
    if (!context->get_executor().running_in_this_thread())
      return asio::post(*context, std::forward<Work>(work));
    lock.unlock();
    work();
  }
};

}  // namespace mdof::rpc
