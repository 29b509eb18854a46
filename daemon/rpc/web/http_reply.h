// Writes the HTTP replies of mdofd. Private header.
#pragma once

#include <string>
#include <string_view>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

struct HttpReply {
  int status = 200;
  std::string_view type = {};  // value of Content-Type; empty: the reply has no such field
  std::string_view body = {};
  std::string fields = {};  // further header fields, each with CR LF at its end
  bool keep_alive = true;
  bool head_only = false;  // true in the reply to HEAD: the body is not sent
};

// Appends a reply, with Content-Length and the header fields that protect the page from other
// pages.
void append_http_reply(std::string& out, const HttpReply& reply);
// Appends an error reply: a sentence as plain text, with "Connection: close".
void append_refusal(std::string& out, const HttpError& error, std::string fields = "");
// Appends the head of an event stream. The stream ends when the connection closes.
void append_stream_head(std::string& out);

// Appends one server-sent event, with the fields "id", "event" and "data". `json` must not contain
// a line end.
void append_event(std::string& out, std::uint64_t id, std::string_view topic,
                  std::string_view json);

}  // namespace mdof::rpc
