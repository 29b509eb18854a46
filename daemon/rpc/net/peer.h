// Who is at the other end of a socket, as the kernel took it down when the client connected.
// Private header.
#pragma once

#include "daemon/rpc/session/peer.h"

namespace mdof::rpc {

Peer peer_of(int socket);  // of a Unix socket; nothing is known of a TCP client

}  // namespace mdof::rpc
