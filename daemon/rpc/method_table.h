// The methods: one row each, from which come dispatch, checks of parameters and rpc.discover.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "daemon/rpc/params/params.h"
#include "daemon/rpc/reply.h"
#include "schema/base/result.h"

namespace mdof::rpc {

enum class ParamType { string, number, integer, boolean, array, object };
const char* to_string(ParamType type);  // as in JSON Schema

// What a value may be at the most, so that no request can ask for more work or memory than a call
// may take. Those of numbers hold for the numbers of an array, too.
struct Bounds {
  double least = -9007199254740992.0, most = 9007199254740992.0;  // 2^53
  std::size_t items = 64;                                         // of an array
  std::size_t bytes = 1024;                                       // of a string
};

struct Param {
  std::string name;  // ends in its unit where it has one
  ParamType type = ParamType::string;
  std::string description;
  bool required = false;
  std::string default_text = {};  // what absence means, as JSON: "0", "\"exact\""
  Bounds bounds = {};
};

// Gives the result as JSON text (one value, UTF-8; a line feed in it is turned into a space).
using SyncHandler = std::function<Result<std::string>(const Params&)>;
// Keeps the Reply until the result is known; Params end with the call.
using AsyncHandler = std::function<void(const Params&, Reply)>;

struct Method {
  std::string name;     // "run.list"
  std::string summary;  // one sentence
  std::vector<Param> params = {};
  std::string result = {};        // a sentence about it, beyond what its members say
  std::string_view members = {};  // its shape, as schema/field/shape.h reads it; empty: any value
  std::string example = "{}";     // params by name
  bool writes = false;            // changes something: refused where a client may only read
  bool subscribes = false;        // needs a connection that stays
  bool approves = false;          // only for the group of ServerOptions::approvers, if there is one
  std::variant<SyncHandler, AsyncHandler> handler;
};

// Built once, then only read, by one thread; must outlive the server and stay where it is.
class MethodTable {
 public:
  // What rpc.discover says of the whole; the table brings that method itself.
  MethodTable(std::string title, std::string version);
  MethodTable(const MethodTable&) = delete;
  MethodTable& operator=(const MethodTable&) = delete;

  // A name twice, or an example that is not JSON, is a bug.
  void add(Method method);

  const Method* find(std::string_view name) const;
  std::string nearest(std::string_view name) const;  // empty: none is near
  const std::map<std::string, Method, std::less<>>& methods() const { return methods_; }

  // The OpenRPC 1.2.6 document from the method at `offset` on, as many as fit into `max_bytes`:
  // "x-total" is the number of methods, "x-next-offset" is there when some are left. A method alone
  // that does not fit is described without the schema of its result, and says so.
  std::string openrpc(std::size_t offset, std::size_t max_bytes) const;

 private:
  const std::string& schema_of(const Method& method) const;

  std::string title_, version_;
  mutable std::map<std::string, std::string> schemas_;  // of results, made when first asked for
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace mdof::rpc
