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
  std::size_t max_line_bytes = 64 * 1024;   // length of a request without its line end
  std::size_t max_reply_bytes = 48 * 1024;  // length of a sent line with its line end
  std::size_t max_depth = 32;               // nested arrays and objects in a request
  std::size_t max_batch = 100;              // requests in a batch
  std::size_t max_id_bytes = 256;           // length of an id as JSON text

  // Limits of each client. max_unsent_bytes: bytes of replies that wait until the client reads. A
  // request begins only if the largest possible reply still fits into this limit.
  std::size_t max_unsent_bytes = 1024 * 1024;
  std::chrono::microseconds turn{100};  // duration of a turn; then the other clients get a turn
  std::size_t max_subscriptions = 32;
  // Pending events of one subscription; if there are more, the oldest event is dropped.
  std::size_t max_queued_events = 64;
  milliseconds request_timeout{5000};  // time from the first byte of a line to its last byte
  // Time during which the client reads none of the unsent output.
  milliseconds stall_timeout{10000};
  milliseconds idle_timeout{0};  // time without a request and without a subscription; 0: no limit
  milliseconds drain_timeout{1000};  // time for the client to read the last line before the
                                     // connection closes

  // Limits of the server.
  std::size_t max_connections = 64;
  std::size_t max_connections_of_user = 32;  // sum of the Unix and TCP connections of one user
  // One of max_connections is reserved for clients in this group. The control of the machine is in
  // this group, and can thus connect even if other users have all other connections.
  std::optional<gid_t> kept_for_group;
  // Only clients in this group may call methods with Method::approves. nullopt: every client that
  // may write may call these methods.
  struct Group {
    gid_t id = 0;
    std::string name;
  };
  std::optional<Group> approvers;
  bool tcp_may_write = false;  // true: clients over loopback TCP may call methods that change data

  // Limits of browsers. Connections of browsers do not count in max_connections. max_line_bytes
  // limits the body of a request. request_timeout limits the time for the head of a request, and
  // the time for its body. If a browser connects beyond max_http_connections, the server closes the
  // connection of a browser that has been idle longest.
  std::size_t max_http_connections = 128;
  std::size_t max_http_streams = 64;  // maximum number of connections with GET /events
  std::size_t max_http_head_bytes = 8 * 1024;
  milliseconds http_idle_timeout{15000};  // time between two requests
  // Interval of the comments that are sent on a stream without events.
  milliseconds http_heartbeat{10000};
  std::size_t max_kept_events = 4096;  // events that are kept for streams that resume
  std::size_t max_kept_event_bytes = 1024 * 1024;

  // Writes one line of the log; empty function: the log goes to stderr.
  std::function<void(const std::string&)> log;
};

}  // namespace mdof::rpc
