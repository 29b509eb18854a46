// An interface to the thread on which all sessions run.
#pragma once

#include <functional>

namespace mdof::rpc {

class Executor {
 public:
  virtual ~Executor() = default;
  // Thread-safe. Runs `work` on the thread of the sessions: at once if the caller is on that
  // thread, otherwise later. Drops `work` if that thread accepts no more work.
  virtual void dispatch(std::function<void()> work) = 0;
};

}  // namespace mdof::rpc
