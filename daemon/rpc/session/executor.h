// An interface to the thread on which all sessions run.
#pragma once

#include <functional>

namespace mdof::rpc {

class Executor {
 public:
  virtual ~Executor() = default;
  // Thread-safe. Runs `work` on this thread: at once if the caller is on this thread, otherwise
  // later. Drops `work` if the thread accepts no more work.
  virtual void dispatch(std::function<void()> work) = 0;
};

}  // namespace mdof::rpc
