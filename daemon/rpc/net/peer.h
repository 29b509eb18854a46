// The process at the other end of a socket. The kernel recorded it when the client connected.
// Private header.
#pragma once

#include "daemon/rpc/session/peer.h"

namespace mdof::rpc {

// Unix socket: the credentials of the client. TCP: the owner of the client's socket, if the kernel
// reports it.
Peer peer_of(int socket);

}  // namespace mdof::rpc
