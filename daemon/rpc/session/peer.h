// Who is at the other end of a transport, taken down when the client connected.
#pragma once

#include <sys/types.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "daemon/rpc/caller.h"

namespace mdof::rpc {

struct Peer {
  std::optional<Credentials> credentials = {};  // nothing where the kernel does not know: TCP
  std::vector<gid_t> further_groups = {};       // beside that of the credentials
  // Of a TCP client of this machine: whose socket it is. Counts for places and gives no right, as
  // that of a Unix socket does.
  std::optional<uid_t> socket_owner = {};
  // Of a browser each request has its own right: its token, and nothing else, lets it write.
  enum class Http { no, reads, writes };
  Http http = Http::no;

  bool is_member(gid_t group) const {  // never without credentials
    const auto& further = further_groups;
    return credentials && (credentials->gid == group ||
                           std::find(further.begin(), further.end(), group) != further.end());
  }
};

}  // namespace mdof::rpc
