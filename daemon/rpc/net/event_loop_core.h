// Implementation of EventLoop. Private header.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/event_loop.h"

namespace mdof::rpc {

struct EventLoop::Core final : Executor {
  std::mutex mutex;  // protects `open`; prevents posts while the context is destroyed
  bool open = true;
  std::unique_ptr<asio::io_context> context = std::make_unique<asio::io_context>(1);

  // Thread-safe. Drops the work after the loop has been destroyed.
  template <class Work>
  void post(Work&& work) {
    const std::scoped_lock lock(mutex);
    if (open) asio::post(*context, std::forward<Work>(work));
  }

  void dispatch(std::function<void()> work) override {
    std::unique_lock lock(mutex);
    if (!open) return;
    if (!context->get_executor().running_in_this_thread())
      return asio::post(*context, std::move(work));
    lock.unlock();
    work();
  }
};

}  // namespace mdof::rpc
