#include "daemon/rpc/net/socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <type_traits>

namespace mdof::rpc {
namespace {

constexpr int kBacklog = 64;
constexpr mode_t kMode = 0660;

// Casts an address to the type of the socket functions.
template <class Address>
sockaddr* as_sockaddr(Address& address) {
  return reinterpret_cast<sockaddr*>(&address);
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

tl::unexpected<Error> cannot(const std::string& what, int number) {
  return io_error(what + ": " + system_error_text(number));
}

// Removes an old socket file before bind(). Errors: the file is not a socket; a process answers on
// this socket.
Status remove_stale(const std::string& path) {
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0) return {};
  if (!S_ISSOCK(info.st_mode))
    return io_error(
        path + ": this file exists and is not a socket; remove the file or configure another path");
  const auto answer = connect_to_unix(path);
  if (answer)
    return fail(
        ErrorCode::conflict,
        path + ": another program (perhaps mdofd) answers on this socket; end that program first");
  if (answer.error() != ECONNREFUSED) return cannot(path, answer.error());
  if (::unlink(path.c_str()) != 0)
    return cannot(path + ": cannot remove the old socket file", errno);
  return {};
}

// Remedy for an error of bind() to a TCP port; "": none.
const char* port_remedy(int number) {
  if (number == EADDRINUSE)
    return "; another program (perhaps mdofd) uses this port: end that program, or choose another "
           "port";
  return number == EACCES ? "; choose a port from 1024 to 65535" : "";
}

template <class Address>
Status bind_and_listen(int fd, Address& address, socklen_t size, const std::string& where) {
  if (::bind(fd, as_sockaddr(address), size) != 0) {
    constexpr bool is_unix = std::is_same_v<Address, sockaddr_un>;
    const int why = errno;
    return io_error(where + ": cannot bind: " + system_error_text(why) +
                    (is_unix ? "" : port_remedy(why)));
  }
  if (::listen(fd, kBacklog) != 0) return cannot(where + ": cannot listen", errno);
  return {};
}

int option(int fd, int name) {
  int value = -1;
  socklen_t size = sizeof value;
  return ::getsockopt(fd, SOL_SOCKET, name, &value, &size) == 0 ? value : -1;
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

std::string system_error_text(int number) {
  return std::error_code(number, std::generic_category()).message();
}

Status check_unix_path(const std::string& path) {
  constexpr std::size_t kMax = sizeof(sockaddr_un::sun_path) - 1;
  if (!path.empty() && path.size() <= kMax && path.find('\0') == std::string::npos) return {};
  return fail(ErrorCode::usage, "socket path \"" + path.substr(0, 2 * kMax) + "\" has " +
                                    std::to_string(path.size()) + " bytes, but must have 1 to " +
                                    std::to_string(kMax) + "; choose another path");
}

tl::expected<Descriptor, int> connect_to_unix(const std::string& path) {
  Descriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (fd.get() < 0) return tl::unexpected(errno);
  sockaddr_un address = unix_address(path);
  if (::connect(fd.get(), as_sockaddr(address), sizeof address) != 0) return tl::unexpected(errno);
  return fd;
}

Result<Descriptor> listen_on_unix(const std::string& path) {
  MDOF_CHECK(check_unix_path(path));
  MDOF_CHECK(remove_stale(path));
  Descriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0) return cannot(path, errno);
  // bind() creates the file with the mode of the descriptor, minus the umask. Setting the mode
  // before bind() ensures that other users cannot connect at any time.
  if (::fchmod(fd.get(), kMode) != 0)
    return cannot(path + ": cannot set the mode of the socket file", errno);
  sockaddr_un address = unix_address(path);
  MDOF_CHECK(bind_and_listen(fd.get(), address, sizeof address, path));
  if (::chmod(path.c_str(), kMode) != 0)
    return cannot(path + ": cannot set the mode of the socket file", errno);
  return fd;
}

Result<Descriptor> listen_on_tcp(const std::string& address, std::uint16_t port) {
  const std::string where = address + " port " + std::to_string(port);
  const bool v6 = address == "::1";
  if (!v6 && address != "127.0.0.1")
    return fail(ErrorCode::usage, where + ": only 127.0.0.1 and ::1 are permitted");
  Descriptor fd(::socket(v6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0) return cannot(where, errno);
  const int on = 1;
  (void)::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in6 six{};
  six.sin6_family = AF_INET6;
  six.sin6_addr = in6addr_loopback;
  six.sin6_port = htons(port);
  sockaddr_in four{};
  four.sin_family = AF_INET;
  four.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  four.sin_port = htons(port);
  MDOF_CHECK(v6 ? bind_and_listen(fd.get(), six, sizeof six, where)
                : bind_and_listen(fd.get(), four, sizeof four, where));
  return fd;
}

Status check_listening(int fd) {
  const int domain = option(fd, SO_DOMAIN);
  const bool known = domain == AF_UNIX || domain == AF_INET || domain == AF_INET6;
  if (known && option(fd, SO_ACCEPTCONN) == 1 && option(fd, SO_TYPE) == SOCK_STREAM) return {};
  return fail(ErrorCode::usage, "descriptor " + std::to_string(fd) +
                                    " is not a listening stream socket; see ListenStream= of the "
                                    "systemd socket unit");
}

std::uint16_t port_of(int socket) {
  sockaddr_in6 address{};  // large enough for IPv4, too; the port has the same offset
  socklen_t size = sizeof address;
  if (::getsockname(socket, as_sockaddr(address), &size) != 0) return 0;
  const bool tcp = address.sin6_family == AF_INET || address.sin6_family == AF_INET6;
  return tcp ? ntohs(address.sin6_port) : std::uint16_t{0};
}

}  // namespace mdof::rpc
