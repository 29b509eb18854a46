// Who is at the other end of a socket, as the kernel took it down when the client connected.
// Private header.
#pragma once

#include "daemon/rpc/session/peer.h"

namespace mdof::rpc {

// Of a Unix socket its credentials; of a TCP client whose socket it is, where the kernel says so
// that.
Peer peer_of(int socket);

}  // namespace mdof::rpc
