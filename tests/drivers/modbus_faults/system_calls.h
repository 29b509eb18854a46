// Replaces system calls in the whole test program. For the descriptor of world.line they act on
// the virtual line, for all other descriptors on the real system. Include this file in only one
// source file, in a program without other tests. Shared libraries use these functions too, because
// the linker prefers symbols of the program.
#pragma once

#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <cerrno>
#include <ctime>

#include "tests/drivers/modbus_faults/virtual_line.h"

namespace mdof::drivers {

inline bool is_virtual(int fd) {
  return world.active && world.line && world.line->fd() == fd;
}
inline timespec to_timespec(std::int64_t ns) {
  return {ns / 1'000'000'000, ns % 1'000'000'000};
}

// These functions have their own C++ names and the linker names of the C library, because headers
// of the C library may contain inline versions.
// NOLINTBEGIN(misc-definitions-in-headers): for one file, see above
extern "C" {

ssize_t virtual_read(int fd, void* into, std::size_t size) __asm__("read");
ssize_t virtual_read(int fd, void* into, std::size_t size) {
  return is_virtual(fd) ? world.line->take(into, size) : ::syscall(SYS_read, fd, into, size);
}

ssize_t virtual_recv(int fd, void* into, std::size_t size, int flags) __asm__("recv");
ssize_t virtual_recv(int fd, void* into, std::size_t size, int flags) {
  return is_virtual(fd) ? world.line->take(into, size)
                        : ::syscall(SYS_recvfrom, fd, into, size, flags, nullptr, nullptr);
}

ssize_t virtual_write(int fd, const void* bytes, std::size_t size) __asm__("write");
ssize_t virtual_write(int fd, const void* bytes, std::size_t size) {
  return is_virtual(fd) ? world.line->put(bytes, size) : ::syscall(SYS_write, fd, bytes, size);
}

ssize_t virtual_send(int fd, const void* bytes, std::size_t size, int flags) __asm__("send");
ssize_t virtual_send(int fd, const void* bytes, std::size_t size, int flags) {
  return is_virtual(fd) ? world.line->put(bytes, size)
                        : ::syscall(SYS_sendto, fd, bytes, size, flags, nullptr, 0);
}

int virtual_poll(pollfd* fds, nfds_t n, int timeout_ms) __asm__("poll");
int virtual_poll(pollfd* fds, nfds_t n, int timeout_ms) {
  if (n == 1 && is_virtual(fds->fd)) {
    if ((fds->events & POLLIN) == 0) return fds->revents = POLLOUT, 1;
    const bool came = world.line->wait(world.now_ns + timeout_ms * std::int64_t{1'000'000});
    fds->revents = static_cast<short>(came ? POLLIN : 0);
    return came ? 1 : 0;
  }
  const timespec timeout = to_timespec(timeout_ms * std::int64_t{1'000'000});
  return static_cast<int>(
      ::syscall(SYS_ppoll, fds, n, timeout_ms < 0 ? nullptr : &timeout, nullptr, 0));
}

// Like Linux, stores the unused time in `left`.
int virtual_select(int n, fd_set* in, fd_set* out, fd_set* except, timeval* left) __asm__("select");
int virtual_select(int n, fd_set* in, fd_set* out, fd_set* except, timeval* left) {
  std::int64_t left_ns = left ? left->tv_sec * 1'000'000'000 + left->tv_usec * 1'000 : 0;
  if (in && is_virtual(n - 1)) {
    const std::int64_t until_ns = left ? world.now_ns + left_ns : INT64_MAX;
    const bool came = world.line->wait(until_ns);
    if (!came) FD_ZERO(in);
    if (left) {
      left_ns = until_ns - world.now_ns;
      *left = {left_ns / 1'000'000'000, left_ns % 1'000'000'000 / 1'000};
    }
    return came ? 1 : 0;
  }
  timespec timeout = to_timespec(left_ns);
  return static_cast<int>(
      ::syscall(SYS_pselect6, n, in, out, except, left ? &timeout : nullptr, nullptr));
}

int virtual_clock_gettime(clockid_t clock, timespec* time) __asm__("clock_gettime");
int virtual_clock_gettime(clockid_t clock, timespec* time) {
  if (!world.active || clock != CLOCK_MONOTONIC)
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  *time = to_timespec(world.now_ns);
  return 0;
}

}  // extern "C"
// NOLINTEND(misc-definitions-in-headers)
}  // namespace mdof::drivers
