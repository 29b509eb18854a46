#include "daemon/rpc/server_core.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

using std::chrono::milliseconds;

// Limits that contradict each other are brought into what can be kept.
ServerOptions consistent(ServerOptions o) {
  constexpr std::size_t kLeastReply = 16 * 1024;  // the longest error has room
  o.max_reply_bytes = std::max(o.max_reply_bytes, kLeastReply);
  o.max_unsent_bytes = std::max(o.max_unsent_bytes, 2 * o.max_reply_bytes);
  o.max_id_bytes = std::clamp<std::size_t>(o.max_id_bytes, 32, 1024);
  const std::size_t member = Exchange::kReserveBytes + o.max_id_bytes;
  o.max_batch = std::clamp<std::size_t>(o.max_batch, 1, o.max_reply_bytes / member - 1);
  o.max_depth = std::max<std::size_t>(o.max_depth, 4);
  o.requests_per_turn = std::max<std::size_t>(o.requests_per_turn, 1);
  return o;
}

// Often enough to keep a limit to within an eighth of it.
milliseconds sweep_period(const ServerOptions& o) {
  milliseconds least = std::min({o.request_timeout, o.stall_timeout, o.drain_timeout});
  if (o.idle_timeout.count() > 0) least = std::min(least, o.idle_timeout);
  return std::clamp(least / 8, milliseconds(5), milliseconds(250));
}

}  // namespace

ServerCore::ServerCore(std::shared_ptr<EventLoop::Core> event_loop, const MethodTable& table,
                       ServerOptions limits)
    : loop(std::move(event_loop)),
      options(consistent(std::move(limits))),
      dispatcher(loop, table, options),
      topics(options),
      sweep_timer_(*loop->context),
      due_timer_(*loop->context) {}

ServerCore::~ServerCore() {
  for (const auto& connection : std::exchange(connections, {})) connection->close();
}

void ServerCore::adopt(int socket) {
  if (connections.size() >= options.max_connections) return turn_away(socket);
  full_ = false;
  connections.push_back(std::make_shared<Connection>(*this, socket));
  connections.back()->start();
  if (!std::exchange(sweeping_, true)) sweep();
}

void ServerCore::turn_away(int socket) {
  std::string line;
  append_error(line, "null", kBusy,
               "all " + std::to_string(options.max_connections) +
                   " connections are in use: close one, or raise max_connections");
  line += '\n';
  (void)::send(socket, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ::close(socket);
  if (!std::exchange(full_, true)) log("all connections are in use; more are turned away");
}

void ServerCore::forget(const Connection& connection) {
  std::erase_if(connections, [&](const auto& c) { return c.get() == &connection; });
}

void ServerCore::sweep() {
  for (const auto& connection : std::vector(connections)) connection->check_times(Clock::now());
  if (connections.empty()) {
    sweeping_ = false;
    return;
  }
  sweep_timer_.expires_after(sweep_period(options));
  sweep_timer_.async_wait([weak = weak_from_this()](const std::error_code& error) {
    if (const auto self = weak.lock(); self && !error) self->sweep();
  });
}

void ServerCore::wake_subscribers_at(Clock::time_point when) {
  if (due_ && *due_ <= when) return;
  due_ = when;
  due_timer_.expires_at(when);
  due_timer_.async_wait([weak = weak_from_this()](const std::error_code& error) {
    const auto self = weak.lock();
    if (!self || error) return;  // gone, or an earlier time took its place
    self->due_.reset();
    self->wake_subscribers();
  });
}

void ServerCore::wake_subscribers() {
  for (const auto& connection : connections)
    if (!connection->subscriptions.empty()) connection->wake();
}

void ServerCore::log(const std::string& line) const {
  if (options.log)
    options.log(line);
  else
    std::fprintf(stderr, "rpc: %s\n", line.c_str());
}

}  // namespace mdof::rpc
