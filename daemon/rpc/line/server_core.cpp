#include "daemon/rpc/line/server_core.h"

#include <algorithm>
#include <utility>

#include "daemon/rpc/net/peer.h"

namespace mdof::rpc {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::microseconds kSlice{300};

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
  // One who comes again and again is not before those who stay.
  order_.charge(connection->share(), service.options().turn);
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
  sweep_timer_.async_wait([weak = weak_from_this()](const LoopError& error) {
    if (const auto self = weak.lock(); self && !error) self->sweep();
  });
}

void ServerCore::ask_for_turn(std::shared_ptr<Connection> connection) {
  if (connection.get() == in_turn_) {
    again_ = true;  // once its turn has been charged
    return;
  }
  const FairShare share = connection->share();
  order_.add(std::move(connection), share);
  post_turns();
}

void ServerCore::post_turns() {
  if (std::exchange(turns_posted_, true)) return;
  loop->post([weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->give_turns();
  });
}

// In slices, between which the loop looks at sockets and timers: a request that has just come needs
// not wait for all who are before it in the queue of the loop.
void ServerCore::give_turns() {
  turns_posted_ = false;
  auto now = Clock::now();
  const auto end = now + kSlice;
  while (!order_.empty() && now < end) {
    auto connection = order_.take();
    in_turn_ = connection.get();
    again_ = false;
    connection->take_turn();
    in_turn_ = nullptr;
    const auto after = Clock::now();
    order_.charge(connection->share(), after - std::exchange(now, after));
    const FairShare share = connection->share();
    if (again_) order_.add(std::move(connection), share);
  }
  if (!order_.empty()) post_turns();
}

void ServerCore::wake_subscribers_at(Clock::time_point when) {
  if (due_ && *due_ <= when) return;
  due_ = when;
  due_timer_.expires_at(when);
  due_timer_.async_wait([weak = weak_from_this()](const LoopError& error) {
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
