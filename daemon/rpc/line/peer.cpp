#include "daemon/rpc/line/peer.h"

#include <sys/socket.h>

#include <algorithm>
#include <vector>

namespace mdof::rpc {
namespace {

// As they were when the client connected. Empty as well where the kernel cannot tell.
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

std::optional<Credentials> credentials_of(int socket) {
  int domain = 0;
  socklen_t size = sizeof domain;
  if (::getsockopt(socket, SOL_SOCKET, SO_DOMAIN, &domain, &size) != 0 || domain != AF_UNIX)
    return std::nullopt;
  ucred peer{};
  size = sizeof peer;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return Credentials{peer.uid, peer.gid, peer.pid};
}

bool is_member(int socket, gid_t group) {
  const auto own = credentials_of(socket);
  if (!own) return false;
  const auto further = further_groups(socket);
  return own->gid == group || std::find(further.begin(), further.end(), group) != further.end();
}

}  // namespace mdof::rpc
