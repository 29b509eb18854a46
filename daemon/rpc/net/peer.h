// The process at the other end of a socket, as recorded by the kernel at connection. Private
// header.
#pragma once

#include "daemon/rpc/session/peer.h"

namespace mdof::rpc {

// For a Unix socket its credentials; for a TCP client the owner of its socket, if the kernel
// reports it.
Peer peer_of(int socket);

}  // namespace mdof::rpc
