// The object with which a handler answers one call, now or later, from any thread.
#pragma once

#include <memory>
#include <string>

#include "schema/base/result.h"

namespace mdof::rpc {

// Move-only. Call operator() once, with JSON text or an Error. If the Reply is destroyed before
// this call, the client gets the error -32603. Any thread may own and call it. If the client or the
// server no longer exists, the answer is dropped.
class Reply {
 public:
  struct Slot;  // see exchange.h

  explicit Reply(std::unique_ptr<Slot> slot);
  ~Reply();
  Reply(Reply&&) noexcept;
  Reply& operator=(Reply&&) noexcept;

  void operator()(Result<std::string> result);

  // Identifies the client. All calls of one client have equal pointers. The pointers expire when
  // the client disconnects. Do not call this function after the answer.
  std::weak_ptr<const void> client() const;

 private:
  std::unique_ptr<Slot> slot_;  // empty after the answer
};

}  // namespace mdof::rpc
