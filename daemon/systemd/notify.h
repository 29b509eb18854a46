// Communication between mdofd and systemd (sd_notify(3), sd_listen_fds(3)). If systemd did not
// start the process, these functions send nothing and find no socket.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::systemd {

// Notify systemd that mdofd is ready or is stopping. `systemctl status mdofd` shows `status`.
void notify_ready(std::string_view status);
void notify_stopping(std::string_view status);

// The longest interval between two calls of feed_watchdog(). It is half of WatchdogSec. nullopt: no
// watchdog is set.
std::optional<std::chrono::microseconds> watchdog_interval();
// Notifies the watchdog. Call this function only when all threads have reported in time. Never call
// it from a timer alone.
void feed_watchdog();

// The listening sockets that systemd has opened, in the order of mdofd.socket. The caller must
// close them. If the list is empty, the caller opens its own socket. Later calls and child
// processes receive an empty list. Error: one of the sockets is not a listening stream socket.
Result<std::vector<int>> take_listen_sockets();

}  // namespace mdof::systemd
