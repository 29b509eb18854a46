// Writes JSON-RPC 2.0 messages, each without its line end. Private header.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

// An error message's and its data's length; more is cut off.
inline constexpr std::size_t kMaxErrorText = 1024;

// `id` and `json` are JSON text. A line end inside `json` becomes a space.
void append_result(std::string& out, std::string_view id, std::string_view json);
void append_error(std::string& out, std::string_view id, int code, std::string_view message,
                  std::string_view data = {});
// With the words of its remedy in the message, and the code of it in {"data": {"remedy": …}}.
void append_error(std::string& out, std::string_view id, const Error& error);
void append_notification(std::string& out, std::string_view method, std::string_view params);

// The method and the params of what append_notification() wrote.
struct Notification {
  std::string_view method, params;
};
Notification notification_of(std::string_view message);

// Text of a client in a message to it: quoted, not longer than a name reasonably is.
std::string in_quotes(std::string_view text);

}  // namespace mdof::rpc
