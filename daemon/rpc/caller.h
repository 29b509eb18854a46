// The client of a call, as a method handler sees it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::rpc {

// User, group and process of a client, from SO_PEERCRED. The kernel records them when the client
// connects.
struct Credentials {
  uid_t uid = 0;
  gid_t gid = 0;
  pid_t pid = 0;
};

// Thread-bound: use a Caller only on the event loop, and only while the handler that received it
// runs.
class Caller {
 public:
  virtual ~Caller() = default;

  // The user whom the history of actions names; nullopt for a TCP client.
  virtual std::optional<Credentials> credentials() const = 0;
  virtual bool may_write() const = 0;
  // True for a request of a browser. The session of such a request ends with the reply. The request
  // contains the permission to write (token).
  virtual bool over_http() const = 0;
  virtual bool in_group(gid_t group) const = 0;           // false without credentials
  virtual std::vector<gid_t> further_groups() const = 0;  // groups besides the group of the
                                                          // credentials

  // The subscription ends with unsubscribe() or with the connection. A second call for the same
  // topic changes the interval. Errors: not_found: no such topic; usage: the interval is below the
  // minimum of the topic, or the client has too many subscriptions.
  virtual Status subscribe(std::string_view topic, std::chrono::milliseconds interval) = 0;
  virtual Status unsubscribe(std::string_view topic) = 0;
};

}  // namespace mdof::rpc
