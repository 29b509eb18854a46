#include "daemon/rpc/message.h"

#include <algorithm>

#include "schema/base/json_writer.h"

namespace mdof::rpc {
namespace {

constexpr std::size_t kMaxQuoted = 64;

void append_json(std::string& out, std::string_view json) {
  const std::size_t begin = out.size();
  out += json;
  for (std::size_t i = out.find_first_of("\r\n", begin); i != std::string::npos;
       i = out.find_first_of("\r\n", i))
    out[i] = ' ';
}

}  // namespace

void append_result(std::string& out, std::string_view id, std::string_view json) {
  out += R"({"jsonrpc":"2.0","result":)";
  append_json(out, json);
  out += R"(,"id":)";
  out += id;
  out += '}';
}

void append_error(std::string& out, std::string_view id, int code, std::string_view message,
                  std::string_view data) {
  JsonWriter error;
  error.begin_object().field("code", code).field("message", message.substr(0, kMaxErrorText));
  if (!data.empty()) error.field("data", data.substr(0, kMaxErrorText));
  error.end_object();
  out += R"({"jsonrpc":"2.0","error":)";
  out += error.text();
  out += R"(,"id":)";
  out += id;
  out += '}';
}

void append_notification(std::string& out, std::string_view method, std::string_view params) {
  JsonWriter name;
  name.value(method);
  out += R"({"jsonrpc":"2.0","method":)";
  out += name.text();
  out += R"(,"params":)";
  append_json(out, params);
  out += '}';
}

std::string in_quotes(std::string_view text) {
  const bool whole = text.size() <= kMaxQuoted;
  return '"' + std::string(text.substr(0, kMaxQuoted)) + (whole ? "\"" : "...\"");
}

}  // namespace mdof::rpc
