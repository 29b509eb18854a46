#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "drivers/io/byte_stream.h"
#include "drivers/io/connect_remedy.h"
#include "drivers/io/peer.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr unsigned kGiveUp_ms = 5000;
constexpr int kIdle_s = 5, kInterval_s = 2, kProbes = 3;

template <class T>
void set(int fd, int level, int option, T value) {
  ::setsockopt(fd, level, option, &value, sizeof value);  // optional, so errors are ignored
}

void enable_keep_alive(int fd) {
  set(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  set(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, kGiveUp_ms);
  set(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(fd, IPPROTO_TCP, TCP_KEEPIDLE, kIdle_s);
  set(fd, IPPROTO_TCP, TCP_KEEPINTVL, kInterval_s);
  set(fd, IPPROTO_TCP, TCP_KEEPCNT, kProbes);
}

// Returns 0 if connected, otherwise the errno of the failure.
int finish_connect(int fd, steady_clock::time_point until) {
  const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
  pollfd p{fd, POLLOUT, 0};
  const int n = ::poll(&p, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
  if (n == 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  if (n < 0 || ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) != 0) return errno;
  return error;
}

std::string ip_address(const addrinfo& a) {
  char text[NI_MAXHOST] = "";
  ::getnameinfo(a.ai_addr, a.ai_addrlen, text, sizeof text, nullptr, 0, NI_NUMERICHOST);
  return text;
}

}  // namespace

std::string Endpoint::text() const {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

Result<Endpoint> parse_endpoint(const std::string& text, int default_port) {
  const std::string remedy =
      "\"" + text + "\" is not an address; give an address such as 192.168.0.5:502";
  Endpoint to{text, default_port};
  std::string port;
  if (text.starts_with('[')) {
    const auto end = text.find(']');
    if (end == std::string::npos) return bad_input(remedy);
    to.host = text.substr(1, end - 1);
    port = text.substr(end + 1);
  } else if (const auto colon = text.find(':'); colon != std::string::npos) {
    to.host = text.substr(0, colon);
    port = text.substr(colon);
  }
  if (!port.empty()) {
    const char* end = port.data() + port.size();
    const auto [stop, error] = std::from_chars(port.data() + 1, end, to.port);
    if (port[0] != ':' || error != std::errc() || stop != end) return bad_input(remedy);
  }
  if (to.host.empty() || to.port < 1 || to.port > 65535) return bad_input(remedy);
  return to;
}

Result<ByteStream> connect_tcp(const Endpoint& to, milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  addrinfo hints{}, *list = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  const std::string port = std::to_string(to.port);
  if (const int rc = ::getaddrinfo(to.host.c_str(), port.c_str(), &hints, &list); rc != 0)
    return io_error(to.text() + ": " + ::gai_strerror(rc) + "; check the address");
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(list, ::freeaddrinfo);
  int error = ETIMEDOUT;
  std::string address;
  for (const addrinfo* a = list; a; a = a->ai_next) {
    address = ip_address(*a);
    const int fd = ::socket(a->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) {
      error = errno;
      continue;
    }
    ByteStream stream(fd, to.text());
    enable_keep_alive(fd);
    error = ::connect(fd, a->ai_addr, a->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) error = finish_connect(fd, until);
    if (error == 0) return stream;
  }
  const bool service = std::getenv("INVOCATION_ID") != nullptr;  // systemd sets this variable
  return tl::unexpected(connect_error(to, address, error, service));
}

Error connect_error(const Endpoint& to, const std::string& address, int error, bool service) {
  Error why{ErrorCode::io, to.text() + ": " + std::strerror(error)};
  const bool forbidden = error == EPERM || error == EACCES;
  why.message +=
      forbidden ? "; a firewall, or IPAddressDeny of systemd, forbids the connection"
                : "; check that the device is switched on and connected to the network, and that "
                  "the address is correct";
  if (forbidden || (service && error == ETIMEDOUT)) {
    why.remedy = Remedy::allow_network;
    why.remedy_for = address;
  }
  return why;
}

std::uint32_t peer_ipv4(const ByteStream& connection) {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  if (::getpeername(connection.fd(), reinterpret_cast<sockaddr*>(&peer), &size) != 0) return 0;
  if (peer.ss_family != AF_INET) return 0;
  sockaddr_in v4{};
  std::memcpy(&v4, &peer, sizeof v4);
  return ntohl(v4.sin_addr.s_addr);
}

}  // namespace mdof::drivers
