// The process at the other end of a transport, as recorded when it connected.
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
  // Owner of the socket of a TCP client on this machine. mdofd uses this uid only to limit the
  // connections of a user (max_connections_of_user); the client gets no permissions from this uid.
  std::optional<uid_t> socket_owner = {};
  // no: not a browser. reads, writes: a request of a browser, without or with the token that
  // permits writing.
  enum class Http { no, reads, writes };
  Http http = Http::no;

  bool is_member(gid_t group) const {  // always false without credentials
    const auto& further = further_groups;
    return credentials && (credentials->gid == group ||
                           std::find(further.begin(), further.end(), group) != further.end());
  }
};

}  // namespace mdof::rpc
