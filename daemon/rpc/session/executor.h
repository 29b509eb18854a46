// The thread on which all sessions run, as an interface.
#pragma once

#include <functional>

namespace mdof::rpc {

class Executor {
 public:
  virtual ~Executor() = default;
  // Thread-safe. Runs `work` on that thread: at once if called there, otherwise later. Drops it if
  // the thread accepts no more work.
  virtual void dispatch(std::function<void()> work) = 0;
};

}  // namespace mdof::rpc
