// An object with which one call is answered, now or later, from any thread.
#pragma once

#include <memory>
#include <string>

#include "schema/base/result.h"

namespace mdof::rpc {

// Move-only. Call it once, with JSON text or an Error. If it is destroyed without an answer, the
// client gets -32603. Any thread may own and call it. If the client or the server no longer exists,
// the answer is dropped.
class Reply {
 public:
  struct Slot;  // see exchange.h

  explicit Reply(std::unique_ptr<Slot> slot);
  ~Reply();
  Reply(Reply&&) noexcept;
  Reply& operator=(Reply&&) noexcept;

  void operator()(Result<std::string> result);

  // Identity of the client: equal for all calls of one client, expired after it has disconnected.
  // Do not call it after the answer.
  std::weak_ptr<const void> client() const;

 private:
  std::unique_ptr<Slot> slot_;  // empty after the answer
};

}  // namespace mdof::rpc
