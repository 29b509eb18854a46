// What the connections of a server share. Private header.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/rpc/dispatcher.h"
#include "daemon/rpc/line/asio.h"
#include "daemon/rpc/line/connection.h"
#include "daemon/rpc/line/event_loop_core.h"
#include "daemon/rpc/line/server_options.h"
#include "daemon/rpc/topic_hub.h"

namespace mdof::rpc {

// Thread-bound: the loop.
struct ServerCore : std::enable_shared_from_this<ServerCore> {
  using Clock = std::chrono::steady_clock;

  ServerCore(std::shared_ptr<EventLoop::Core> event_loop, const MethodTable& table,
             ServerOptions limits);
  ~ServerCore();

  void adopt(int socket);  // a connected client, or one too many
  void forget(const Connection& connection);
  void wake_subscribers_at(Clock::time_point when);
  void log(const std::string& line) const;

  std::shared_ptr<EventLoop::Core> loop;
  const ServerOptions options;
  Dispatcher dispatcher;
  TopicHub topics;
  std::vector<std::shared_ptr<Connection>> connections;

 private:
  enum class Place { none, ordinary, kept };
  Place place_for(int socket, std::string& why_not) const;
  void turn_away(int socket, const std::string& why);
  void sweep();
  void wake_subscribers();

  asio::steady_timer sweep_timer_;
  bool sweeping_ = false;
  asio::steady_timer due_timer_;
  std::optional<Clock::time_point> due_;
  std::string told_;  // the log, why a client was turned away
};

}  // namespace mdof::rpc
