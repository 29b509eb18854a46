// All limits of the server, with their defaults.
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

  // Limits of lines and messages.
  std::size_t max_line_bytes = 64 * 1024;   // one request, without its line end
  std::size_t max_reply_bytes = 48 * 1024;  // one sent line, with its line end
  std::size_t max_depth = 32;               // nesting depth of a request
  std::size_t max_batch = 100;              // members of a batch
  std::size_t max_id_bytes = 256;           // one id as JSON text

  // Limits of one client.
  std::size_t max_unsent_bytes = 1024 * 1024;  // a request only begins if its reply fits
  std::chrono::microseconds turn{100};         // after this time the other clients get a turn
  std::size_t max_subscriptions = 32;
  std::size_t max_queued_events = 64;  // length of the queue of one subscription to events; when
                                       // full, the oldest event is dropped
  milliseconds request_timeout{5000};  // limit for a whole line, from its first byte
  milliseconds stall_timeout{10000};   // time during which the client takes none of the unsent
                                       // output
  milliseconds idle_timeout{0};        // limit without request and subscription; 0: no limit
  milliseconds drain_timeout{1000};    // time for the client to read the last line before the
                                       // connection closes

  // Limits of the server.
  std::size_t max_connections = 64;
  std::size_t max_connections_of_user = 32;  // connections of one uid, over Unix and TCP sockets
                                             // together
  // One of max_connections is reserved for this group, the group of the machine's control, even if
  // other users have all other connections.
  std::optional<gid_t> kept_for_group;
  // Only this group may call methods that approve; nullopt: every client that may write.
  struct Group {
    gid_t id = 0;
    std::string name;
  };
  std::optional<Group> approvers;
  bool tcp_may_write = false;  // allows writing methods over loopback TCP

  // Limits of browsers; their connections do not count among those above. The body of a request is
  // limited by max_line_bytes; request_timeout limits the head, and then the body.
  std::size_t max_http_connections = 128;  // beyond it, the connection that has been idle longest
                                           // is closed
  std::size_t max_http_streams = 64;       // maximum number of connections with GET /events
  std::size_t max_http_head_bytes = 8 * 1024;
  milliseconds http_idle_timeout{15000};  // limit between two requests
  milliseconds http_heartbeat{10000};     // on a stream without events
  std::size_t max_kept_events = 4096;     // for streams that resume
  std::size_t max_kept_event_bytes = 1024 * 1024;

  std::function<void(const std::string&)> log;  // one line; empty: to stderr
};

}  // namespace mdof::rpc
