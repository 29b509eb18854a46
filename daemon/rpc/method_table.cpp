#include "daemon/rpc/method_table.h"

#include <algorithm>
#include <cassert>

#include "daemon/rpc/codes.h"
#include "schema/base/json_page.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/field/shape.h"

namespace mdof::rpc {
namespace {

// Size of a JSON-RPC reply with its id, but without the document.
constexpr std::size_t kEnvelopeBytes = 512;
constexpr std::size_t kEndBytes = 64;  // size of the text after the methods
constexpr const char* kLeftOut =
    R"({"description":"the schema does not fit into max_bytes; give a larger max_bytes"})";

// Writes the bounds with the names of JSON Schema. "maxLength" counts characters; a text never has
// more characters than bytes.
void write_bounds(JsonWriter& json, const Param& param) {
  const Bounds none;
  const bool numeric = param.type == ParamType::number || param.type == ParamType::integer;
  if (numeric && param.bounds.least != none.least) json.field("minimum", param.bounds.least);
  if (numeric && param.bounds.most != none.most) json.field("maximum", param.bounds.most);
  if (param.type == ParamType::array)
    json.field("maxItems", static_cast<std::uint64_t>(param.bounds.items));
  if (param.type == ParamType::string)
    json.field("maxLength", static_cast<std::uint64_t>(param.bounds.bytes));
}

std::string describe(const Param& param) {
  JsonWriter json;
  json.begin_object().field("name", param.name).field("description", param.description);
  json.field("required", param.required).key("schema").begin_object();
  json.field("type", to_string(param.type));
  write_bounds(json, param);
  if (!param.default_text.empty()) json.key("default").raw(param.default_text);
  json.end_object().end_object();
  return json.take();
}

// The example is in "x-example-params", because an example of OpenRPC must contain a result, and
// the result depends on the data.
std::string describe(const Method& method, const std::string& schema) {
  JsonWriter json;
  json.begin_object().field("name", method.name).field("summary", method.summary);
  json.field("paramStructure", "either").key("params").begin_array();
  for (const Param& param : method.params) json.raw(describe(param));
  json.end_array().key("result").begin_object().field("name", "result");
  if (!method.result.empty()) json.field("description", method.result);
  json.key("schema").raw(schema).end_object();
  json.field("x-writes", method.writes).key("x-example-params").raw(method.example);
  json.end_object();
  return json.take();
}

// Writes the error codes as components of OpenRPC.
void write_components(JsonWriter& json) {
  json.key("components").begin_object().key("errors").begin_object();
  for (const CodeMeaning& each : code_meanings())
    json.key(each.name)
        .begin_object()
        .field("code", each.code)
        .field("message", each.message)
        .end_object();
  json.end_object().end_object();
}

Method discover_method(const MethodTable& table) {
  return {.name = "rpc.discover",
          .summary = "Describes all methods in an OpenRPC 1.2.6 document.",
          .params = {{"offset", ParamType::integer, "index of the first method on this page", false,
                      "0"},
                     {"max_bytes", ParamType::integer,
                      "limit of the reply line in bytes, from 4096 to 49152", false, "49152"}},
          .members =
              "{openrpc, info: {title, version: string}, components?, x-total, methods: [object], "
              "x-next-offset?}",
          .example = R"({"offset":0})",
          .handler = [&table](const Params& params) -> Result<std::string> {
            const std::int64_t offset = params.integer("offset");
            const std::int64_t bytes = params.integer("max_bytes", 49152);
            if (offset < 0) return fail(ErrorCode::usage, "offset: must not be negative");
            if (bytes < 4096 || bytes > 49152)
              return fail(ErrorCode::usage, "max_bytes: must be from 4096 to 49152");
            return table.openrpc(static_cast<std::size_t>(offset),
                                 static_cast<std::size_t>(bytes) - kEnvelopeBytes);
          }};
}

}  // namespace

const char* to_string(ParamType type) {
  switch (type) {
    case ParamType::string:
      return "string";
    case ParamType::number:
      return "number";
    case ParamType::integer:
      return "integer";
    case ParamType::boolean:
      return "boolean";
    case ParamType::array:
      return "array";
    case ParamType::object:
      return "object";
  }
  return "";
}

MethodTable::MethodTable(std::string title, std::string version)
    : title_(std::move(title)), version_(std::move(version)) {
  add(discover_method(*this));
}

void MethodTable::add(Method method) {
  std::string name = method.name;
  [[maybe_unused]] const bool added = methods_.emplace(std::move(name), std::move(method)).second;
  assert(added && "a method with this name already exists");
}

const Method* MethodTable::find(std::string_view name) const {
  const auto found = methods_.find(name);
  return found == methods_.end() ? nullptr : &found->second;
}

std::string MethodTable::nearest(std::string_view name) const {
  if (name.size() > 64) return {};  // comparing long texts takes long and is useless
  std::vector<std::string> names;
  for (const auto& [known, method] : methods_) names.push_back(known);
  return nearest_candidate(name, names);
}

const std::string& MethodTable::schema_of(const Method& method) const {
  std::string& schema = schemas_[method.name];
  if (schema.empty()) schema = method.members.empty() ? "{}" : json_schema(method.members);
  return schema;
}

std::string MethodTable::openrpc(std::size_t offset, std::size_t max_bytes) const {
  JsonWriter json;
  json.begin_object().field("openrpc", "1.2.6").key("info").begin_object();
  json.field("title", title_).field("version", version_).end_object();
  if (offset == 0) write_components(json);
  json.field("x-total", static_cast<std::uint64_t>(methods_.size())).key("methods").begin_array();
  std::vector<const Method*> left;
  for (const auto& [name, method] : methods_) left.push_back(&method);
  left.erase(left.begin(),
             left.begin() + static_cast<std::ptrdiff_t>(std::min(offset, left.size())));
  const std::size_t room = max_bytes - std::min(max_bytes, json.text().size() + kEndBytes);
  const auto text = [&](const Method* method) {
    std::string whole = describe(*method, schema_of(*method));
    return whole.size() <= room ? whole : describe(*method, kLeftOut);
  };
  const std::size_t end = offset + append_page(json, left, text, max_bytes);
  json.end_array();
  if (end < methods_.size()) json.field("x-next-offset", static_cast<std::uint64_t>(end));
  return json.end_object().take();
}

}  // namespace mdof::rpc
