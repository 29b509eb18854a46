// The methods, one row each. Dispatch, parameter checks and rpc.discover use these rows.
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

// Limits of a value, so that a request cannot demand more work or memory than a call may use.
// Limits of numbers also hold for the numbers of an array.
struct Bounds {
  double least = -9007199254740992.0, most = 9007199254740992.0;  // 2^53
  std::size_t items = 64;    // maximum number of elements of an array
  std::size_t bytes = 1024;  // maximum length of a string
};

struct Param {
  std::string name;  // ends with the unit, if it has one
  ParamType type = ParamType::string;
  std::string description;
  bool required = false;
  std::string default_text = {};  // value of an absent parameter, as JSON: "0", "\"exact\""
  Bounds bounds = {};
};

// Returns the result as JSON text (one value, UTF-8). A line feed in it becomes a space.
using SyncHandler = std::function<Result<std::string>(const Params&)>;
// Keeps the Reply until the result is known. Params are only valid during the call.
using AsyncHandler = std::function<void(const Params&, Reply)>;

struct Method {
  std::string name;     // "run.list"
  std::string summary;  // one sentence
  std::vector<Param> params = {};
  std::string result = {};        // a sentence with information beyond the members
  std::string_view members = {};  // shape of the result, in the syntax of schema/field/shape.h;
                                  // empty: any value
  std::string example = "{}";     // params by name
  bool writes = false;            // changes something; rejected if the client may only read
  bool subscribes = false;        // needs a permanent connection
  bool approves = false;          // only for the group ServerOptions::approvers, if given
  std::variant<SyncHandler, AsyncHandler> handler;
};

// Built once, then only read, by one thread. It must outlive the server and must not move.
class MethodTable {
 public:
  // Title and version in rpc.discover; the table adds that method itself.
  MethodTable(std::string title, std::string version);
  MethodTable(const MethodTable&) = delete;
  MethodTable& operator=(const MethodTable&) = delete;

  // A repeated name, or an example that is not JSON, is a programming error.
  void add(Method method);

  const Method* find(std::string_view name) const;
  std::string nearest(std::string_view name) const;  // empty: no similar name
  const std::map<std::string, Method, std::less<>>& methods() const { return methods_; }

  // The OpenRPC 1.2.6 document from the method at `offset` on, with as many methods as fit into
  // `max_bytes`. "x-total" is the number of methods; "x-next-offset" exists if some are left. A
  // single method that does not fit is described without the schema of its result, and a
  // description states this.
  std::string openrpc(std::size_t offset, std::size_t max_bytes) const;

 private:
  const std::string& schema_of(const Method& method) const;

  std::string title_, version_;
  mutable std::map<std::string, std::string> schemas_;  // schemas of results, made on first use
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace mdof::rpc
