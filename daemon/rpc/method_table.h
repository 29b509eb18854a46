// The table of all methods. Each method has one row. The server uses this row to call the method,
// to check its parameters, and to describe it in rpc.discover.
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

// Limits of a parameter's value, which limit the work and memory that a request can demand. The
// limits of numbers also apply to each number in an array.
struct Bounds {
  double least = -9007199254740992.0, most = 9007199254740992.0;  // 2^53
  std::size_t items = 64;    // maximum number of elements of an array
  std::size_t bytes = 1024;  // maximum length of a string
};

struct Param {
  std::string name;  // ends with the unit, if the value has one
  ParamType type = ParamType::string;
  std::string description;
  bool required = false;
  std::string default_text = {};  // value of an absent parameter, as JSON: "0", "\"exact\""
  Bounds bounds = {};
};

// Returns the result as JSON text: one value, UTF-8. A line feed in the text becomes a space.
using SyncHandler = std::function<Result<std::string>(const Params&)>;
// Receives a Reply, and calls it when the result is known. Params are only valid during the call of
// the handler.
using AsyncHandler = std::function<void(const Params&, Reply)>;

struct Method {
  std::string name;     // "run.list"
  std::string summary;  // one sentence
  std::vector<Param> params = {};
  std::string result = {};  // a sentence with facts that `members` does not state
  // Members of the result, in the syntax of schema/field/shape.h; empty: any value.
  std::string_view members = {};
  std::string example = "{}";  // params by name
  // The method changes data; the server rejects the call if the client may only read.
  bool writes = false;
  bool subscribes = false;  // the method needs a connection that stays open
  bool approves = false;  // only clients in the group ServerOptions::approvers may call the method,
                          // if this group is set
  std::variant<SyncHandler, AsyncHandler> handler;
};

// The table is complete before the server starts; then one thread reads it. The table must exist
// longer than the server and must not move.
class MethodTable {
 public:
  // Title and version that rpc.discover states. The table contains the method rpc.discover from the
  // start.
  MethodTable(std::string title, std::string version);
  MethodTable(const MethodTable&) = delete;
  MethodTable& operator=(const MethodTable&) = delete;

  // Programming errors: a method with this name exists already; the example is not JSON.
  void add(Method method);

  const Method* find(std::string_view name) const;
  std::string nearest(std::string_view name) const;  // empty: no similar name
  const std::map<std::string, Method, std::less<>>& methods() const { return methods_; }

  // Returns an OpenRPC 1.2.6 document. It describes the methods from number `offset`, as many as
  // fit into `max_bytes`. "x-total" is the number of all methods. "x-next-offset" is the number of
  // the next method; it is missing after the last method. If the first method alone does not fit,
  // the document describes it without the schema of its result, and states this.
  std::string openrpc(std::size_t offset, std::size_t max_bytes) const;

 private:
  const std::string& schema_of(const Method& method) const;

  std::string title_, version_;
  // Schemas of results; a schema is made when it is first needed.
  mutable std::map<std::string, std::string> schemas_;
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace mdof::rpc
