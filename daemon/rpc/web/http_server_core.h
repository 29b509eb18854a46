// Data that the connections of browsers share. Private header.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

#include "daemon/rpc/net/client_set.h"
#include "daemon/rpc/web/events/kept_events.h"
#include "daemon/rpc/web/http_connection.h"
#include "daemon/rpc/web/http_server.h"
#include "daemon/rpc/web/served_files.h"

namespace mdof::rpc {

// Thread-bound to the event loop.
struct HttpServerCore final : ClientSet<HttpConnection> {
  HttpServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared, HttpSetup given);
  ~HttpServerCore() override;

  // `socket`: a connected client; it is rejected if there are too many clients.
  void adopt(int socket);
  void request_turn(std::shared_ptr<HttpConnection> connection);
  std::size_t stream_count() const;
  static std::string allowed(std::string_view path);  // value of the field Allow

  const HttpSetup setup;
  const ServedFiles files;
  KeptEvents kept;

 private:
  bool make_room();
  void wake_streams();
  Clock::time_point give_turn(Clock::time_point now) override;
  bool has_waiting_clients() const override { return !waiting_.empty(); }
  void wake_due() override;
  std::chrono::milliseconds least_limit() const override;

  // Connections that wait for a turn, the first one first.
  std::deque<std::shared_ptr<HttpConnection>> waiting_;
};

}  // namespace mdof::rpc
