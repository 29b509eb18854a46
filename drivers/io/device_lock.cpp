#include "drivers/io/device_lock.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "schema/base/sha256.h"

namespace mdof::drivers {
namespace {

// Largest number of connections that wait for answer_inquiries().
constexpr int kPendingInquiries = 64;
constexpr int kKind = SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK;

struct Name {
  sockaddr_un address{};
  socklen_t size = 0;
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&address); }
};

// The first byte of the socket name is 0, which makes the name abstract.
Name name_of(const std::string& identity) {
  Name name;
  name.address.sun_family = AF_UNIX;
  std::string text = "mdof device " + identity;
  if (text.size() > sizeof name.address.sun_path - 1) text = "mdof device " + sha256_hex(identity);
  std::memcpy(name.address.sun_path + 1, text.data(), text.size());
  name.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  return name;
}

// Returns the process that has the lock; 0: not known.
pid_t lock_holder(Name& name) {
  const int fd = ::socket(AF_UNIX, kKind, 0);
  if (fd < 0) return 0;
  ucred peer{};
  socklen_t size = sizeof peer;
  const bool known = ::connect(fd, name.get(), name.size) == 0 &&
                     ::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  ::close(fd);
  return known ? peer.pid : 0;
}

tl::unexpected<Error> device_in_use_error(pid_t pid) {
  if (pid == ::getpid())
    return io_error(
        "another device of the configuration already uses the same hardware; remove one of these "
        "two devices");
  if (pid == 0)
    return io_error("the device is in use by another program", Remedy::ask_daemon_for_device);
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string program;
  std::getline(file, program);
  if (program.empty()) program = "another program";
  return io_error("the device is in use by " + program + " (process " + std::to_string(pid) + ")",
                  Remedy::ask_daemon_for_device);
}

}  // namespace

std::string identity_of(const Endpoint& at) {
  addrinfo hints{}, *list = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(at.host.c_str(), nullptr, &hints, &list) != 0) return "tcp " + at.text();
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(list, ::freeaddrinfo);
  std::array<char, NI_MAXHOST> host{};
  if (::getnameinfo(list->ai_addr, list->ai_addrlen, host.data(), host.size(), nullptr, 0,
                    NI_NUMERICHOST) != 0)
    return "tcp " + at.text();
  return "tcp " + Endpoint{host.data(), at.port}.text();
}

std::string identity_of_path(const std::string& path) {
  std::error_code failed;
  const auto real = std::filesystem::weakly_canonical(path, failed);
  return failed ? path : real.string();
}

Result<DeviceLock> DeviceLock::take(const std::string& identity, bool shared) {
  Name name = name_of(identity);
  DeviceLock lock(::socket(AF_UNIX, kKind, 0));
  if (lock.fd_ < 0) return lock;
  if (::bind(lock.fd_, name.get(), name.size) == 0) {
    (void)::listen(lock.fd_, kPendingInquiries);
    return lock;
  }
  if (errno != EADDRINUSE) return lock;
  const pid_t holder = lock_holder(name);
  if (shared && holder == ::getpid()) return DeviceLock(-1);
  return device_in_use_error(holder);
}

void DeviceLock::answer_inquiries() const {
  for (int asker = 0; fd_ >= 0 && asker >= 0;) {
    asker = ::accept4(fd_, nullptr, nullptr, SOCK_CLOEXEC);
    if (asker >= 0) ::close(asker);
  }
}

DeviceLock::~DeviceLock() {
  if (fd_ >= 0) ::close(fd_);
}

DeviceLock::DeviceLock(DeviceLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

DeviceLock& DeviceLock::operator=(DeviceLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

}  // namespace mdof::drivers
