// One message of JSON-RPC 2.0 in, its reply out: parsing, the rules of the specification, calling.
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

// A batch of which not all members have been called yet.
struct BegunBatch {
  std::shared_ptr<Exchange> exchange;  // none: no batch is under way
  std::size_t next = 0;                // member
};

struct Handled {
  bool open = false;   // the reply comes later, through the sink
  bool begun = false;  // of a batch there is more to call
};

// Thread-bound: the loop. Not reentrant: a handler must not bring about another handle().
class Dispatcher {
 public:
  Dispatcher(std::shared_ptr<Executor> executor, const MethodTable& table,
             const ServerOptions& options);
  ~Dispatcher();

  using Clock = std::chrono::steady_clock;

  // `message` is followed by kPadding readable bytes of any value. Appends the reply to `out` where
  // it is known at once; it never has a line end in it. No member of a batch is called after
  // `until`, but the first: the same message with the same `batch` then goes on with it.
  Handled handle(std::string_view message, Caller& caller, std::weak_ptr<ReplySink> sink,
                 std::string& out, BegunBatch& batch, Clock::time_point until);

  static constexpr std::size_t kPadding = 64;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace mdof::rpc
