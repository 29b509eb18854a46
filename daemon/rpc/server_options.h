// Every limit of the server, with its default.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace mdof::rpc {

struct ServerOptions {
  using milliseconds = std::chrono::milliseconds;

  // Of a line and a message.
  std::size_t max_line_bytes = 64 * 1024;   // of a request, without its line end
  std::size_t max_reply_bytes = 48 * 1024;  // of any line sent, with its line end
  std::size_t max_depth = 32;               // nesting of a request
  std::size_t max_batch = 100;              // members
  std::size_t max_id_bytes = 256;           // of an id, as JSON text

  // Of a client.
  std::size_t max_unsent_bytes = 1024 * 1024;  // no request is begun whose reply may not fit
  std::chrono::microseconds turn{100};         // then the other clients have theirs
  std::size_t max_subscriptions = 32;
  std::size_t max_queued_events = 64;  // a subscription to events; then the oldest are dropped
  milliseconds request_timeout{5000};  // for a whole line, from its first byte
  milliseconds stall_timeout{10000};   // unsent output of which the client takes nothing
  milliseconds idle_timeout{0};        // neither request nor subscription; 0: for ever
  milliseconds drain_timeout{1000};    // for the client to take the last line before a close

  // Of the server.
  std::size_t max_connections = 64;
  std::size_t max_connections_of_user = 32;  // of one uid, over Unix and TCP sockets together
  // Of max_connections one is kept for this group, that of the machine's control: whoever else has
  // all the others.
  std::optional<gid_t> kept_for_group;
  // Who alone may call the methods that approve; none: whoever may write.
  struct Group {
    gid_t id = 0;
    std::string name;
  };
  std::optional<Group> approvers;
  bool tcp_may_write = false;  // methods that write, over loopback TCP

  // Of browsers, whose connections do not count among those above. A request's body may have
  // max_line_bytes; its head, and then its body, has request_timeout.
  std::size_t max_http_connections = 128;  // beyond it the one that has been idle longest goes
  std::size_t max_http_streams = 64;       // of these: GET /events
  std::size_t max_http_head_bytes = 8 * 1024;
  milliseconds http_idle_timeout{15000};  // between two requests
  milliseconds http_heartbeat{10000};     // of a stream on which nothing happens
  std::size_t max_kept_events = 4096;     // for a stream that resumes
  std::size_t max_kept_event_bytes = 1024 * 1024;

  std::function<void(const std::string&)> log;  // one line; empty: to stderr
};

}  // namespace mdof::rpc
