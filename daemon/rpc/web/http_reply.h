// HTTP replies of mdofd, with the header fields of all replies. Private header.
#pragma once

#include <string>
#include <string_view>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

struct HttpReply {
  int status = 200;
  std::string_view type = {};  // Content-Type; empty: none
  std::string_view body = {};
  std::string fields = {};  // further fields, each with CR LF
  bool keep_alive = true;
  bool head_only = false;  // reply to HEAD
};

// Adds Content-Length and the security fields.
void append_http_reply(std::string& out, const HttpReply& reply);
// A sentence as plain text; closes the connection.
void append_refusal(std::string& out, const HttpError& error, std::string fields = "");
// The head of an event stream, which ends with the connection.
void append_stream_head(std::string& out);

// One event: "id", "event" and "data" in the form of server-sent events. `json` has no line end.
void append_event(std::string& out, std::uint64_t id, std::string_view topic,
                  std::string_view json);

}  // namespace mdof::rpc
