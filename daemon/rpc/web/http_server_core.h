// What the connections of browsers share. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/session/service.h"
#include "daemon/rpc/web/http_connection.h"
#include "daemon/rpc/web/http_server.h"
#include "daemon/rpc/web/kept_events.h"
#include "daemon/rpc/web/served_files.h"

namespace mdof::rpc {

// Thread-bound: the loop.
struct HttpServerCore : std::enable_shared_from_this<HttpServerCore> {
  using Clock = std::chrono::steady_clock;

  HttpServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared, HttpSetup given);
  ~HttpServerCore();

  void adopt(int socket);  // a connected client, or one too many
  void forget(const HttpConnection& connection);
  void ask_for_turn(std::shared_ptr<HttpConnection> connection);
  void wake_streams_at(Clock::time_point when);
  std::size_t stream_count() const;
  static std::string allowed(std::string_view path);  // the field Allow

  std::shared_ptr<EventLoop::Core> loop;
  Service& service;
  const HttpSetup setup;
  const ServedFiles files;
  KeptEvents kept;
  std::vector<std::shared_ptr<HttpConnection>> connections;

 private:
  bool make_room();
  void sweep();
  void wake_streams();
  void wake_due_streams();
  void post_turns();
  void give_turns();

  std::deque<std::shared_ptr<HttpConnection>> waiting_;  // for a turn, one after the other
  bool turns_posted_ = false;
  asio::steady_timer sweep_timer_;
  bool sweeping_ = false;
  asio::steady_timer due_timer_;
  std::optional<Clock::time_point> due_;
};

}  // namespace mdof::rpc
