// The messages between the daemon and systemd (sd_notify(3), sd_listen_fds(3)). All of it is
// without effect where systemd did not start the process: nothing is sent, no socket is found.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::systemd {

// Ready to serve; `status` is the line that `systemctl status mdofd` shows.
void notify_ready(std::string_view status);
void notify_status(std::string_view status);
void notify_stopping(std::string_view status);

// How often at least the watchdog is to be fed: half of WatchdogSec. None: no watchdog is set.
std::optional<std::chrono::microseconds> watchdog_interval();
// To be called by the work itself once all of it has shown that it goes on; never by a timer alone.
void feed_watchdog();

// The listening sockets that mdofd.socket passes, in its order; they are the caller's to close.
// None: the caller makes its own. Later calls and child processes find none. Error: one of them is
// not a listening stream socket.
Result<std::vector<int>> take_listen_sockets();

}  // namespace mdof::systemd
