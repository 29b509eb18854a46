// The one thread that sessions run on, as others see it.
#pragma once

#include <functional>

namespace mdof::rpc {

class Executor {
 public:
  virtual ~Executor() = default;
  // Thread-safe. Runs `work` on that thread: at once when called there, else in a later turn; once
  // the thread takes no more work, never.
  virtual void dispatch(std::function<void()> work) = 0;
};

}  // namespace mdof::rpc
