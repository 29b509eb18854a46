// The right to answer one call, now or later, from any thread.
#pragma once

#include <memory>
#include <string>

#include "schema/base/result.h"

namespace mdof::rpc {

// Move-only. Answers once: with JSON text or an Error; destroyed without an answer, the client gets
// -32603. Thread-safe in that any one thread may hold and call it; the client may have gone, or
// the whole server: then the answer goes nowhere.
class Reply {
 public:
  struct Slot;  // see exchange.h

  explicit Reply(std::unique_ptr<Slot> slot);
  ~Reply();
  Reply(Reply&&) noexcept;
  Reply& operator=(Reply&&) noexcept;

  void operator()(Result<std::string> result);

  // Who asked: the same for all calls of one client, expired once it has gone. Not after the
  // answer.
  std::weak_ptr<const void> client() const;

 private:
  std::unique_ptr<Slot> slot_;  // empty once answered
};

}  // namespace mdof::rpc
