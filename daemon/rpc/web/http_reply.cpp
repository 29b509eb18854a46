#include "daemon/rpc/web/http_reply.h"

#include <array>
#include <cassert>
#include <utility>

namespace mdof::rpc {
namespace {

constexpr std::array<std::pair<int, std::string_view>, 17> kReasons{{
    {200, "OK"},
    {204, "No Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {408, "Request Timeout"},
    {411, "Length Required"},
    {413, "Content Too Large"},
    {415, "Unsupported Media Type"},
    {421, "Misdirected Request"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {501, "Not Implemented"},
    {503, "Service Unavailable"},
    {505, "HTTP Version Not Supported"},
}};

// These header fields have the effect that mdofd's page runs only scripts of mdofd, and that other
// pages can neither embed nor read it.
constexpr std::string_view kSecurity =
    "Content-Security-Policy: default-src 'self'; style-src 'self'; object-src 'none'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n";

std::string_view reason_of(int status) {
  for (const auto& [code, reason] : kReasons)
    if (code == status) return reason;
  assert(false && "this HTTP status has no text");
  return "";
}

void append_start(std::string& out, int status) {
  out += "HTTP/1.1 ";
  out += std::to_string(status);
  out += ' ';
  out += reason_of(status);
  out += "\r\n";
  out += kSecurity;
}

}  // namespace

void append_http_reply(std::string& out, const HttpReply& reply) {
  append_start(out, reply.status);
  out += reply.fields;
  if (!reply.type.empty()) {
    out += "Content-Type: ";
    out += reply.type;
    out += "\r\n";
  }
  if (reply.status != 204 && reply.status != 304)
    out += "Content-Length: " + std::to_string(reply.body.size()) + "\r\n";
  if (!reply.keep_alive) out += "Connection: close\r\n";
  out += "\r\n";
  if (!reply.head_only) out += reply.body;
}

void append_refusal(std::string& out, const HttpError& error, std::string fields) {
  const std::string body = error.text + "\n";
  fields += "Cache-Control: no-store\r\n";
  append_http_reply(out, {.status = error.status,
                          .type = "text/plain; charset=utf-8",
                          .body = body,
                          .fields = std::move(fields),
                          .keep_alive = false});
}

void append_stream_head(std::string& out) {
  append_start(out, 200);
  out +=
      "Content-Type: text/event-stream\r\n"
      "Cache-Control: no-store\r\n"
      "X-Accel-Buffering: no\r\n"
      "Connection: close\r\n\r\n";
}

void append_event(std::string& out, std::uint64_t id, std::string_view topic,
                  std::string_view json) {
  out += "id: ";
  out += std::to_string(id);
  out += "\nevent: ";
  out += topic;
  out += "\ndata: ";
  out += json;
  out += "\n\n";
}

}  // namespace mdof::rpc
