// Who is at the other end of a Unix socket, as the kernel took it down when the client connected.
// Private header.
#pragma once

#include <sys/types.h>

#include <optional>

#include "daemon/rpc/caller.h"

namespace mdof::rpc {

std::optional<Credentials> credentials_of(int socket);  // nothing for TCP
// By the client's own group or one of its further ones. Not of a TCP client.
bool is_member(int socket, gid_t group);

}  // namespace mdof::rpc
