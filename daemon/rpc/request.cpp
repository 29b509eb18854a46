#include "daemon/rpc/request.h"

#include "schema/base/json_writer.h"

namespace mdof::rpc {
namespace {

using simdjson::dom::element;
using MaybeElement = std::optional<element>;

struct Members {
  MaybeElement jsonrpc, method, params, id;
  std::string_view twice;  // name of a repeated member; empty: none
  bool id_twice = false;
};

Members members_of(const simdjson::dom::object& message) {
  Members out;
  const auto keep = [&](MaybeElement& slot, std::string_view key, const element& value) {
    if (slot) out.twice = key;
    slot = value;
  };
  for (const auto [key, value] : message) {
    if (key == "jsonrpc") keep(out.jsonrpc, key, value);
    if (key == "method") keep(out.method, key, value);
    if (key == "params") keep(out.params, key, value);
    out.id_twice = out.id_twice || (key == "id" && out.id);
    if (key == "id") keep(out.id, key, value);
  }
  return out;
}

// The text of the id if it is a number. Reads the line again, with a parser that keeps the text of
// numbers. Empty: the id was not found.
std::string number_text(const Source& source) {
  using namespace simdjson;
  ondemand::parser parser;
  ondemand::document document;
  const std::size_t size = source.line.size();
  if (parser.iterate(source.line.data(), size, size + SIMDJSON_PADDING).get(document)) return {};
  std::string_view token;
  const auto error = source.member ? document.at(*source.member)["id"].raw_json_token().get(token)
                                   : document["id"].raw_json_token().get(token);
  if (error) return {};
  return std::string(token.substr(0, token.find_first_of(" \t\r\n,}")));
}

std::string id_text(const element& id, const Source& source) {
  std::int64_t whole = 0;
  std::string_view text;
  if (id.get(text) == simdjson::SUCCESS) {
    JsonWriter json;
    json.value(text);
    return json.take();
  }
  if (id.is_int64() && id.get(whole) == simdjson::SUCCESS && whole != 0)
    return std::to_string(whole);
  std::string exact = id.is_number() ? number_text(source) : "";  // 1.50, 1e3, -0
  return exact.empty() ? simdjson::minify(id) : exact;
}

bool is_valid_id_value(const element& id) {
  return id.is_string() || id.is_number() || id.is_null();
}

// Why the message is not a valid request; nullopt: it is valid. The text is empty if the JSON-RPC
// specification shows the error object for this case; the server then sends exactly this object.
std::optional<std::string> fault_of(const Members& members) {
  // A repeated member is an error, because another reader of the line (a log, a filter) could use
  // the other value.
  if (!members.twice.empty()) return "member \"" + std::string(members.twice) + "\" is given twice";
  if (!members.method || !members.method->is_string()) return "";
  std::string_view version;
  if (!members.jsonrpc || members.jsonrpc->get(version) || version != "2.0")
    return "member \"jsonrpc\" must be \"2.0\"";
  if (members.params && !members.params->is_array() && !members.params->is_object())
    return "member \"params\" must be an array or an object";
  return std::nullopt;
}

void read_id(const element& id, const Source& source, std::size_t max_id_bytes, Request& out) {
  out.id = is_valid_id_value(id) ? id_text(id, source) : "null";
  if (!is_valid_id_value(id)) out.invalid = "member \"id\" must be a string, a number or null";
  if (out.id.size() <= max_id_bytes) return;
  out.id = "null";
  out.invalid = "member \"id\" is longer than " + std::to_string(max_id_bytes) + " bytes";
}

}  // namespace

Request read_request(const element& message, const Source& source, std::size_t max_id_bytes) {
  Request out;
  simdjson::dom::object object;
  if (message.get(object)) {
    out.id = "null";
    out.invalid = "";
    return out;
  }
  const Members members = members_of(object);
  out.invalid = fault_of(members);
  if (members.id && !members.id_twice)
    read_id(*members.id, source, max_id_bytes, out);
  else if (out.invalid)
    out.id = "null";
  if (std::string_view name; members.method && !members.method->get(name)) out.method = name;
  out.params = members.params;
  return out;
}

}  // namespace mdof::rpc
