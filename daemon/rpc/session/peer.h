// The process at the other end of a transport, recorded at connection.
#pragma once

#include <sys/types.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "daemon/rpc/caller.h"

namespace mdof::rpc {

struct Peer {
  std::optional<Credentials> credentials = {};  // nullopt if the kernel does not report them (TCP)
  std::vector<gid_t> further_groups = {};       // groups besides the group of the credentials
  // Owner of the socket of a TCP client on this machine. It counts for the limit of connections,
  // like the user of a Unix socket, but gives no permissions.
  std::optional<uid_t> socket_owner = {};
  // Each request of a browser has its own permission: only its token permits writing.
  enum class Http { no, reads, writes };
  Http http = Http::no;

  bool is_member(gid_t group) const {  // always false without credentials
    const auto& further = further_groups;
    return credentials && (credentials->gid == group ||
                           std::find(further.begin(), further.end(), group) != further.end());
  }
};

}  // namespace mdof::rpc
