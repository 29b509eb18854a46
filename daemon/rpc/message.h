// Writes JSON-RPC 2.0 messages, without a line end. Private header.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

// Largest length of an error message, and of its data, in bytes. Longer texts are cut.
inline constexpr std::size_t kMaxErrorText = 1024;

// `id` and `json` are JSON text. A line end inside `json` becomes a space.
void append_result(std::string& out, std::string_view id, std::string_view json);
void append_error(std::string& out, std::string_view id, int code, std::string_view message,
                  std::string_view data = {});
// The message contains the text of the remedy. {"data": {"remedy": …}} contains the code of the
// remedy.
void append_error(std::string& out, std::string_view id, const Error& error);
void append_notification(std::string& out, std::string_view method, std::string_view params);

// Method and params of a message that append_notification() wrote.
struct Notification {
  std::string_view method, params;
};
Notification parse_notification(std::string_view message);

// Puts a text that a client sent into quotes, for a message to this client. Cuts it to the length
// of a usual name.
std::string in_quotes(std::string_view text);

}  // namespace mdof::rpc
