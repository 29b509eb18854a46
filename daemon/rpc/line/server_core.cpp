#include "daemon/rpc/line/server_core.h"

#include <algorithm>
#include <utility>

#include "daemon/rpc/net/peer.h"

namespace mdof::rpc {

std::chrono::milliseconds ServerCore::least_limit() const {
  const ServerOptions& o = service.options();
  const auto least = std::min({o.request_timeout, o.stall_timeout, o.drain_timeout});
  return o.idle_timeout.count() > 0 ? std::min(least, o.idle_timeout) : least;
}

void ServerCore::adopt(int socket) {
  const auto connection = std::make_shared<Connection>(*this, socket);
  auto session = service.admit(peer_of(socket), *connection);
  if (!session) return connection->reject_connection(session.error().message);
  // Adds the duration of a turn to the used time of a new client. Otherwise a client that connects
  // again and again would be served before the others.
  order_.charge(connection->share(), service.options().turn);
  connection->start(std::move(*session));
  begin(connection);
}

void ServerCore::request_turn(std::shared_ptr<Connection> connection) {
  if (connection.get() == in_turn_) {
    again_ = true;  // give_turn() adds the connection to the queue at the end of this turn
    return;
  }
  const FairShare share = connection->share();
  order_.add(std::move(connection), share);
  post_turns();
}

ServerCore::Clock::time_point ServerCore::give_turn(Clock::time_point now) {
  auto connection = order_.take();
  in_turn_ = connection.get();
  again_ = false;
  connection->take_turn();
  in_turn_ = nullptr;
  const auto after = Clock::now();
  order_.charge(connection->share(), after - now);
  const FairShare share = connection->share();
  if (again_) order_.add(std::move(connection), share);
  return after;
}

void ServerCore::wake_due() {
  for (const auto& connection : connections)
    if (connection->has_subscriptions()) connection->wake();
}

}  // namespace mdof::rpc
