// Handles one JSON-RPC 2.0 message and makes its reply: parsing, rules of the specification, calls.
// Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "daemon/rpc/caller.h"
#include "daemon/rpc/method_table.h"
#include "daemon/rpc/server_options.h"
#include "daemon/rpc/session/exchange.h"

namespace mdof::rpc {

// A batch whose members have not all been called yet.
struct BegunBatch {
  std::shared_ptr<Exchange> exchange;  // null: no batch in progress
  std::size_t next = 0;                // index of the next member
};

struct Handled {
  bool open = false;   // the reply comes later, through the sink
  bool begun = false;  // the batch has more members to call
};

// Thread-bound: the event loop. Not reentrant: a handler must not cause another handle().
class Dispatcher {
 public:
  Dispatcher(std::shared_ptr<Executor> executor, const MethodTable& table,
             const ServerOptions& options);
  ~Dispatcher();

  using Clock = std::chrono::steady_clock;

  // `message` must be followed by kPadding readable bytes of any value. Appends the reply to `out`
  // if it is known at once; it never contains a line end. After `until`, no further member of a
  // batch is called (the first one always is); call it again with the same message and `batch` to
  // continue.
  Handled handle(std::string_view message, Caller& caller, std::weak_ptr<ReplySink> sink,
                 std::string& out, BegunBatch& batch, Clock::time_point until);

  static constexpr std::size_t kPadding = 64;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace mdof::rpc
