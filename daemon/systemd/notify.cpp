#include "daemon/systemd/notify.h"

#include <sys/socket.h>
#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace mdof::systemd {
namespace {

// Replaces line ends in the status text. systemd would read a new line as another assignment, such
// as "READY=1".
void notify(std::string state, std::string_view status) {
  std::string line(status);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\0'; }, ' ');
  state += "STATUS=" + line;
  sd_notify(0, state.c_str());  // if systemd did not start mdofd, the error is ignored
}

}  // namespace

void notify_ready(std::string_view status) {
  notify("READY=1\n", status);
}
void notify_stopping(std::string_view status) {
  notify("STOPPING=1\n", status);
}

std::optional<std::chrono::microseconds> watchdog_interval() {
  std::uint64_t limit_us = 0;
  if (sd_watchdog_enabled(0, &limit_us) <= 0) return std::nullopt;
  return std::chrono::microseconds(limit_us / 2);
}

void feed_watchdog() {
  sd_notify(0, "WATCHDOG=1");
}

Result<std::vector<int>> take_listen_sockets() {
  const int count = sd_listen_fds(/*unset_environment=*/1);
  if (count < 0)
    return io_error("sockets from systemd: " + std::string(std::strerror(-count)) +
                    "; start mdofd with mdofd.socket, or unset LISTEN_FDS");
  std::vector<int> sockets;
  for (int fd = SD_LISTEN_FDS_START; fd < SD_LISTEN_FDS_START + count; ++fd) {
    if (sd_is_socket(fd, AF_UNSPEC, SOCK_STREAM, /*listening=*/1) <= 0)
      return io_error("sockets from systemd: descriptor " + std::to_string(fd) +
                      " is not a listening stream socket; use ListenStream= in mdofd.socket");
    sockets.push_back(fd);
  }
  return sockets;
}

}  // namespace mdof::systemd
