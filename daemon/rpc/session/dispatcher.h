// Handles one JSON-RPC 2.0 message: parses it, checks it, calls the methods, and makes the reply.
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

// A batch in which not all requests have been called yet.
struct BegunBatch {
  std::shared_ptr<Exchange> exchange;  // null: no batch in progress
  std::size_t next = 0;                // index of the next request in the batch
};

struct Handled {
  bool open = false;   // the reply is not complete yet; the sink receives it later
  bool begun = false;  // the batch contains requests that have not been called yet
};

// Thread-bound to the event loop. Not reentrant: a handler must not call handle().
class Dispatcher {
 public:
  Dispatcher(std::shared_ptr<Executor> executor, const MethodTable& table,
             const ServerOptions& options);
  ~Dispatcher();

  using Clock = std::chrono::steady_clock;

  // `message` must be followed by kPadding readable bytes of any value. If the reply is known at
  // once, appends it to `out`. A reply contains no line end. After the time `until` the function
  // calls no further request of a batch, but always at least one. To continue, call the function
  // again with the same message and `batch`.
  Handled handle(std::string_view message, Caller& caller, std::weak_ptr<ReplySink> sink,
                 std::string& out, BegunBatch& batch, Clock::time_point until);

  static constexpr std::size_t kPadding = 64;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace mdof::rpc
