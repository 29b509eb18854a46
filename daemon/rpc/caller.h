// The client of a call, as a method handler sees it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::rpc {

// From SO_PEERCRED: the kernel records it when the client connects.
struct Credentials {
  uid_t uid = 0;
  gid_t gid = 0;
  pid_t pid = 0;
};

// Thread-bound: use it on the event loop, and only while the handler that got it runs.
class Caller {
 public:
  virtual ~Caller() = default;

  // The user for the history of a writing method; nullopt for a TCP client.
  virtual std::optional<Credentials> credentials() const = 0;
  virtual bool may_write() const = 0;
  // A browser's request: its session ends with the reply, and the request itself carries the
  // permission to write.
  virtual bool over_http() const = 0;
  virtual bool in_group(gid_t group) const = 0;           // false without credentials
  virtual std::vector<gid_t> further_groups() const = 0;  // groups besides the group of the
                                                          // credentials

  // Holds until unsubscribe() or the end of the connection. A second call for the same topic
  // changes the interval. Errors: not_found (topic); usage (interval below the topic's minimum, too
  // many subscriptions).
  virtual Status subscribe(std::string_view topic, std::chrono::milliseconds interval) = 0;
  virtual Status unsubscribe(std::string_view topic) = 0;
};

}  // namespace mdof::rpc
