// Data that the connections of a line server share. Private header.
#pragma once

#include <chrono>
#include <memory>

#include "daemon/rpc/line/connection.h"
#include "daemon/rpc/net/client_set.h"

namespace mdof::rpc {

// Thread-bound to the event loop.
struct ServerCore final : ClientSet<Connection> {
  using ClientSet::ClientSet;
  ~ServerCore() override { close_all(); }

  // `socket`: a connected client; it is rejected if there are too many clients.
  void adopt(int socket);
  void request_turn(std::shared_ptr<Connection> connection);

 private:
  Clock::time_point give_turn(Clock::time_point now) override;
  bool has_waiting_clients() const override { return !order_.empty(); }
  void wake_due() override;
  std::chrono::milliseconds least_limit() const override;

  FairOrder<std::shared_ptr<Connection>> order_;  // connections that wait for a turn
  bool again_ = false;
  const Connection* in_turn_ = nullptr;
};

}  // namespace mdof::rpc
