#include "daemon/rpc/net/peer.h"

#include <arpa/inet.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>

#include "daemon/rpc/net/socket.h"

namespace mdof::rpc {
namespace {

bool is_unix(int socket) {
  int domain = 0;
  socklen_t bytes = sizeof domain;
  return ::getsockopt(socket, SOL_SOCKET, SO_DOMAIN, &domain, &bytes) == 0 && domain == AF_UNIX;
}

// The groups of the client besides its primary group. Empty also if the kernel does not report
// them.
std::vector<gid_t> further_groups(int socket) {
  socklen_t bytes = 0;
  (void)::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, nullptr,
                     &bytes);  // returns the size of the list
  std::vector<gid_t> groups(bytes / sizeof(gid_t));
  if (groups.empty() || ::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &bytes) != 0)
    return {};
  return groups;
}

// An address in the format of the kernel's socket table.
struct Endpoint {
  sa_family_t family = AF_UNSPEC;
  __be16 port = 0;
  __be32 address[4] = {};
};

Endpoint endpoint_of(const sockaddr_storage& storage) {
  Endpoint end;
  end.family = storage.ss_family;
  if (end.family == AF_INET) {
    sockaddr_in four{};
    std::memcpy(&four, &storage, sizeof four);
    end.port = four.sin_port;
    end.address[0] = four.sin_addr.s_addr;
  } else if (end.family == AF_INET6) {
    sockaddr_in6 six{};
    std::memcpy(&six, &storage, sizeof six);
    end.port = six.sin6_port;
    std::memcpy(end.address, &six.sin6_addr, sizeof end.address);
  }
  return end;
}

template <class Call>
Endpoint endpoint(int socket, Call call) {
  sockaddr_storage storage{};
  socklen_t bytes = sizeof storage;
  const bool known = call(socket, reinterpret_cast<sockaddr*>(&storage), &bytes) == 0;
  return known ? endpoint_of(storage) : Endpoint{};
}

struct OwnerQuestion {
  nlmsghdr head{};
  inet_diag_req_v2 body{};
};

OwnerQuestion question_about(const Endpoint& client, const Endpoint& server) {
  OwnerQuestion ask;
  ask.head.nlmsg_len = sizeof ask;
  ask.head.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  ask.head.nlmsg_flags = NLM_F_REQUEST;
  ask.body.sdiag_family = static_cast<__u8>(client.family);
  ask.body.sdiag_protocol = IPPROTO_TCP;
  ask.body.idiag_states = ~__u32{0};
  auto& id = ask.body.id;
  id.idiag_sport = client.port;
  id.idiag_dport = server.port;
  std::memcpy(id.idiag_src, client.address, sizeof id.idiag_src);
  std::memcpy(id.idiag_dst, server.address, sizeof id.idiag_dst);
  id.idiag_cookie[0] = id.idiag_cookie[1] = INET_DIAG_NOCOOKIE;
  return ask;
}

// Asks the kernel for the owner of the client's socket, which is a socket of this machine. The
// request contains the addresses of this socket; the answer therefore takes the same time for any
// number of sockets.
std::optional<uid_t> owner_of_client(int socket) {
  const Endpoint client = endpoint(socket, ::getpeername), server = endpoint(socket, ::getsockname);
  if (client.family != AF_INET && client.family != AF_INET6) return std::nullopt;
  const Descriptor kernel(
      ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_SOCK_DIAG));
  const OwnerQuestion ask = question_about(client, server);
  if (::send(kernel.get(), &ask, sizeof ask, 0) != static_cast<ssize_t>(sizeof ask))
    return std::nullopt;
  alignas(nlmsghdr) char bytes[1024];
  const ssize_t got = ::recv(kernel.get(), bytes, sizeof bytes, 0);
  if (got < static_cast<ssize_t>(NLMSG_HDRLEN + sizeof(inet_diag_msg))) return std::nullopt;
  nlmsghdr head{};
  inet_diag_msg socket_found{};
  std::memcpy(&head, bytes, sizeof head);
  if (head.nlmsg_type != SOCK_DIAG_BY_FAMILY) return std::nullopt;
  std::memcpy(&socket_found, bytes + NLMSG_HDRLEN, sizeof socket_found);
  return socket_found.idiag_uid;
}

}  // namespace

Peer peer_of(int socket) {
  ucred peer{};
  socklen_t bytes = sizeof peer;
  if (!is_unix(socket)) return {std::nullopt, {}, owner_of_client(socket)};
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &bytes) != 0) return {};
  return {Credentials{peer.uid, peer.gid, peer.pid}, further_groups(socket), std::nullopt};
}

}  // namespace mdof::rpc
