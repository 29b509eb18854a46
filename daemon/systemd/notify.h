// The messages between the daemon and systemd (sd_notify(3), sd_listen_fds(3)). If systemd did not
// start the process, these functions send nothing and find no socket.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::systemd {

// mdofd is ready; `systemctl status mdofd` shows `status`.
void notify_ready(std::string_view status);
void notify_status(std::string_view status);
void notify_stopping(std::string_view status);

// The longest interval for feed_watchdog(): half of WatchdogSec. nullopt: no watchdog is set.
std::optional<std::chrono::microseconds> watchdog_interval();
// Notifies the watchdog. Call it only after all parts have reported progress, never from a mere
// timer.
void feed_watchdog();

// The listening sockets from mdofd.socket, in its order; the caller must close them. Empty: the
// caller opens its own. Later calls and child processes get none. Error: one of them is not a
// listening stream socket.
Result<std::vector<int>> take_listen_sockets();

}  // namespace mdof::systemd
