#include "daemon/rpc/net/peer.h"

#include <sys/socket.h>

namespace mdof::rpc {
namespace {

bool is_unix(int socket) {
  int domain = 0;
  socklen_t bytes = sizeof domain;
  return ::getsockopt(socket, SOL_SOCKET, SO_DOMAIN, &domain, &bytes) == 0 && domain == AF_UNIX;
}

// Empty as well where the kernel cannot tell.
std::vector<gid_t> further_groups(int socket) {
  socklen_t bytes = 0;
  (void)::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, nullptr,
                     &bytes);  // says how many there are
  std::vector<gid_t> groups(bytes / sizeof(gid_t));
  if (groups.empty() || ::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &bytes) != 0)
    return {};
  return groups;
}

}  // namespace

Peer peer_of(int socket) {
  ucred peer{};
  socklen_t bytes = sizeof peer;
  if (!is_unix(socket) || ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &bytes) != 0)
    return {};
  return {Credentials{peer.uid, peer.gid, peer.pid}, further_groups(socket)};
}

}  // namespace mdof::rpc
