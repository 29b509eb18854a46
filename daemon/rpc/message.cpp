#include "daemon/rpc/message.h"

#include <algorithm>
#include <cassert>

#include "daemon/rpc/codes.h"
#include "daemon/words/error_text.h"
#include "schema/base/json_writer.h"

namespace mdof::rpc {
namespace {

constexpr std::size_t kMaxQuoted = 64;
constexpr std::string_view kBeforeMethod = R"({"jsonrpc":"2.0","method":)";
constexpr std::string_view kBeforeParams = R"(,"params":)";

void append_json(std::string& out, std::string_view json) {
  const std::size_t begin = out.size();
  out += json;
  for (std::size_t i = out.find_first_of("\r\n", begin); i != std::string::npos;
       i = out.find_first_of("\r\n", i))
    out[i] = ' ';
}

JsonWriter begin_error(int code, std::string_view message) {
  JsonWriter error;
  error.begin_object().field("code", code).field("message", message.substr(0, kMaxErrorText));
  return error;
}

void end_error(std::string& out, std::string_view id, JsonWriter& error) {
  error.end_object();
  out += R"({"jsonrpc":"2.0","error":)";
  out += error.text();
  out += R"(,"id":)";
  out += id;
  out += '}';
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
  JsonWriter error = begin_error(code, message);
  if (!data.empty()) error.field("data", data.substr(0, kMaxErrorText));
  end_error(out, id, error);
}

void append_error(std::string& out, std::string_view id, const Error& error) {
  JsonWriter json = begin_error(code_of(error.code), words::text(error));
  if (error.remedy != Remedy::none)
    json.key("data").begin_object().field("remedy", to_string(error.remedy)).end_object();
  end_error(out, id, json);
}

void append_notification(std::string& out, std::string_view method, std::string_view params) {
  JsonWriter name;
  name.value(method);
  out += kBeforeMethod;
  out += name.text();
  out += kBeforeParams;
  append_json(out, params);
  out += '}';
}

// The function searches for quotes, because the name of a topic contains none.
Notification parse_notification(std::string_view message) {
  assert(message.starts_with(kBeforeMethod) && message.ends_with('}'));
  message.remove_prefix(kBeforeMethod.size() + 1);
  message.remove_suffix(1);
  const auto end = message.find('"');
  return {message.substr(0, end), message.substr(end + 1 + kBeforeParams.size())};
}

std::string in_quotes(std::string_view text) {
  const bool whole = text.size() <= kMaxQuoted;
  return '"' + std::string(text.substr(0, kMaxQuoted)) + (whole ? "\"" : "...\"");
}

}  // namespace mdof::rpc
