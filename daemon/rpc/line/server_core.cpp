#include "daemon/rpc/line/server_core.h"

#include <algorithm>
#include <utility>

#include "daemon/rpc/net/peer.h"

namespace mdof::rpc {
namespace {

using std::chrono::milliseconds;

// Often enough to keep a limit to within an eighth of it.
milliseconds sweep_period(const ServerOptions& o) {
  milliseconds least = std::min({o.request_timeout, o.stall_timeout, o.drain_timeout});
  if (o.idle_timeout.count() > 0) least = std::min(least, o.idle_timeout);
  return std::clamp(least / 8, milliseconds(5), milliseconds(250));
}

}  // namespace

ServerCore::ServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared)
    : loop(std::move(event_loop)),
      service(shared),
      sweep_timer_(*loop->context),
      due_timer_(*loop->context) {}

ServerCore::~ServerCore() {
  for (const auto& connection : std::exchange(connections, {})) connection->close();
}

void ServerCore::adopt(int socket) {
  const auto connection = std::make_shared<Connection>(*this, socket);
  auto session = service.admit(peer_of(socket), *connection);
  if (!session) return connection->turn_away(session.error().message);
  connections.push_back(connection);
  connection->start(std::move(*session));
  if (!std::exchange(sweeping_, true)) sweep();
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
  sweep_timer_.expires_after(sweep_period(service.options()));
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
    if (connection->has_subscriptions()) connection->wake();
}

}  // namespace mdof::rpc
