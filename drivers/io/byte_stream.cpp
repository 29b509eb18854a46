#include "drivers/io/byte_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Waits until fd is ready, at most until the time `until`. Uses poll(), because select() cannot use
// descriptors above 1023.
bool ready(int fd, short events, steady_clock::time_point until) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    pollfd p{fd, events, 0};
    const int n = ::poll(&p, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
    if (n > 0) return true;
    if (n == 0 || errno != EINTR) return false;
  }
}

// With MSG_NOSIGNAL, a closed connection causes an error and not a signal. A pipe cannot be used
// with send(), so it needs write().
ssize_t put(int fd, std::string_view bytes) {
  const ssize_t n = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return n < 0 && errno == ENOTSOCK ? ::write(fd, bytes.data(), bytes.size()) : n;
}

// A stamp of the kernel is a time of day. If it is older than this, or in the future, somebody has
// set the clock of the computer.
constexpr auto kOldestArrival = milliseconds(100);

// Returns the time of arrival from the kernel; nullopt: the kernel has given no useful time.
std::optional<steady_clock::time_point> arrival_of(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{}, now{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    ::clock_gettime(CLOCK_REALTIME, &now);
    const auto age = std::chrono::seconds(now.tv_sec - stamp.tv_sec) +
                     std::chrono::nanoseconds(now.tv_nsec - stamp.tv_nsec);
    if (age >= age.zero() && age <= kOldestArrival) return steady_clock::now() - age;
  }
  return std::nullopt;
}

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

ByteStream::ByteStream(int fd, std::string name) : fd_(fd), name_(std::move(name)) {
  ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) | O_NONBLOCK);
  ::fcntl(fd_, F_SETFD, FD_CLOEXEC);
}

ByteStream::~ByteStream() {
  if (fd_ >= 0) ::close(fd_);
}

ByteStream::ByteStream(ByteStream&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      name_(std::move(other.name_)),
      keeps_arrival_times_(other.keeps_arrival_times_),
      arrival_(other.arrival_) {}

ByteStream& ByteStream::operator=(ByteStream&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(name_, other.name_);
  std::swap(keeps_arrival_times_, other.keeps_arrival_times_);
  std::swap(arrival_, other.arrival_);
  return *this;
}

void ByteStream::keep_arrival_times() {
  const int yes = 1;
  keeps_arrival_times_ = ::setsockopt(fd_, SOL_SOCKET, SO_TIMESTAMPNS, &yes, sizeof yes) == 0;
}

ssize_t ByteStream::receive(std::span<char> into) {
  if (!keeps_arrival_times_) {
    const ssize_t n = ::read(fd_, into.data(), into.size());
    arrival_ = steady_clock::now();
    return n;
  }
  iovec bytes{into.data(), into.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control;
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t n = ::recvmsg(fd_, &message, 0);
  if (n > 0) arrival_ = arrival_of(message).value_or(steady_clock::now());
  return n;
}

Result<std::size_t> ByteStream::read(std::span<char> into, milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  for (;;) {
    // Usually no bytes are pending, and a read() without waiting would fail (EAGAIN).
    const bool came = timeout > milliseconds(0) && ready(fd_, POLLIN, until);
    const ssize_t n = receive(into);
    if (n > 0) return static_cast<std::size_t>(n);
    if (n == 0) return io_error(name_ + ": the other side has closed the connection");
    if (!would_block(errno)) return io_error(name_ + ": cannot be read: " + std::strerror(errno));
    if (!came) return 0;
  }
}

Status ByteStream::write(std::string_view bytes, milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  while (!bytes.empty()) {
    const ssize_t n = put(fd_, bytes);
    if (n > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (!would_block(errno)) {
      return io_error(name_ + ": cannot be written: " + std::strerror(errno));
    } else if (!ready(fd_, POLLOUT, until)) {
      return io_error(name_ + ": the other side accepts no more bytes");
    }
  }
  return {};
}

Result<std::size_t> ByteStream::drain(milliseconds quiet, milliseconds limit) {
  const auto until = steady_clock::now() + limit;
  std::array<char, 4096> waste;
  std::size_t total = 0;
  while (steady_clock::now() < until) {
    MDOF_TRY(const std::size_t n, read(waste, quiet));
    if (n == 0) break;
    total += n;
  }
  return total;
}

}  // namespace mdof::drivers
