// The client behind a call, as a method handler sees it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::rpc {

// Of SO_PEERCRED: taken by the kernel when the client connected.
struct Credentials {
  uid_t uid = 0;
  gid_t gid = 0;
  pid_t pid = 0;
};

// Thread-bound: the loop, and only while the handler that was given it runs.
class Caller {
 public:
  virtual ~Caller() = default;

  // Who to name in the audit of a writing method; nothing for a TCP client.
  virtual std::optional<Credentials> credentials() const = 0;
  virtual bool may_write() const = 0;
  // A request of a browser: it ends with its reply, and its right to write comes with it.
  virtual bool over_http() const = 0;
  virtual bool in_group(gid_t group) const = 0;           // not where there are no credentials
  virtual std::vector<gid_t> further_groups() const = 0;  // beside that of the credentials

  // Until unsubscribe or the end of the connection; again on the same topic: the new interval
  // holds. Errors: not_found (topic), usage (interval below the topic's minimum, too many).
  virtual Status subscribe(std::string_view topic, std::chrono::milliseconds interval) = 0;
  virtual Status unsubscribe(std::string_view topic) = 0;
};

}  // namespace mdof::rpc
