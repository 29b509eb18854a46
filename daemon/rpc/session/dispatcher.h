// One message of JSON-RPC 2.0 in, its reply out: parsing, the rules of the specification, calling.
// Private header.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "daemon/rpc/caller.h"
#include "daemon/rpc/method_table.h"
#include "daemon/rpc/server_options.h"
#include "daemon/rpc/session/exchange.h"

namespace mdof::rpc {

struct Handled {
  std::size_t requests = 1;  // in this message
  bool open = false;         // the reply comes later, through the sink
};

// Thread-bound: the loop. Not reentrant: a handler must not bring about another handle().
class Dispatcher {
 public:
  Dispatcher(std::shared_ptr<Executor> executor, const MethodTable& table,
             const ServerOptions& options);
  ~Dispatcher();

  // `message` is followed by kPadding readable bytes of any value. Appends the reply to `out` where
  // it is known at once; it never has a line end in it.
  Handled handle(std::string_view message, Caller& caller, std::weak_ptr<ReplySink> sink,
                 std::string& out);

  static constexpr std::size_t kPadding = 64;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace mdof::rpc
