// What the connections of a line server share. Private header.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "daemon/rpc/line/connection.h"
#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/session/service.h"

namespace mdof::rpc {

// Thread-bound: the loop.
struct ServerCore : std::enable_shared_from_this<ServerCore> {
  using Clock = std::chrono::steady_clock;

  ServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared);
  ~ServerCore();

  void adopt(int socket);  // a connected client, or one too many
  void forget(const Connection& connection);
  void wake_subscribers_at(Clock::time_point when);
  void ask_for_turn(std::shared_ptr<Connection> connection);

  std::shared_ptr<EventLoop::Core> loop;
  Service& service;
  std::vector<std::shared_ptr<Connection>> connections;

 private:
  void sweep();
  void wake_subscribers();
  void post_turns();
  void give_turns();

  FairOrder<std::shared_ptr<Connection>> order_;  // who has a request to run
  bool turns_posted_ = false, again_ = false;
  const Connection* in_turn_ = nullptr;
  asio::steady_timer sweep_timer_;
  bool sweeping_ = false;
  asio::steady_timer due_timer_;
  std::optional<Clock::time_point> due_;
};

}  // namespace mdof::rpc
