#include "daemon/rpc/web/http_server_core.h"

#include <algorithm>
#include <utility>

namespace mdof::rpc {
HttpServerCore::HttpServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared,
                               HttpSetup given)
    : ClientSet(std::move(event_loop), shared),
      setup(std::move(given)),
      files(setup.files),
      kept(std::chrono::system_clock::now(),
           {service.options().max_kept_events, service.options().max_kept_event_bytes}) {
  service.on_event([this](std::string_view topic, std::string_view json) {
    kept.add(topic, json);
    wake_streams();
  });
}

HttpServerCore::~HttpServerCore() {
  service.on_event(nullptr);
  close_all();
}

void HttpServerCore::adopt(int socket) {
  const auto connection = std::make_shared<HttpConnection>(*this, socket);
  if (connections.size() >= service.options().max_http_connections && !make_room())
    return connection->reject_connection();
  connection->start();
  begin(connection);
}

// Closes the connection that has waited longest for its next request. Browsers expect that a server
// does this.
bool HttpServerCore::make_room() {
  std::shared_ptr<HttpConnection> oldest;
  for (const auto& connection : connections)
    if (connection->is_idle() && (!oldest || connection->since() < oldest->since()))
      oldest = connection;
  if (oldest) oldest->close();
  return oldest != nullptr;
}

std::size_t HttpServerCore::stream_count() const {
  return static_cast<std::size_t>(std::count_if(connections.begin(), connections.end(),
                                                [](const auto& c) { return c->is_stream(); }));
}

std::string HttpServerCore::allowed(std::string_view path) {
  return path == "/rpc"      ? "Allow: POST\r\n"
         : path == "/events" ? "Allow: GET\r\n"
                             : "Allow: GET, HEAD\r\n";
}

std::chrono::milliseconds HttpServerCore::least_limit() const {
  const ServerOptions& o = service.options();
  return std::min(
      {o.request_timeout, o.stall_timeout, o.drain_timeout, o.http_idle_timeout, o.http_heartbeat});
}

void HttpServerCore::request_turn(std::shared_ptr<HttpConnection> connection) {
  waiting_.push_back(std::move(connection));
  post_turns();
}

HttpServerCore::Clock::time_point HttpServerCore::give_turn(Clock::time_point) {
  const auto connection = std::move(waiting_.front());
  waiting_.pop_front();
  connection->take_turn();
  return Clock::now();
}

void HttpServerCore::wake_due() {
  const auto now = Clock::now();
  for (const auto& connection : connections) {
    const auto due = connection->is_stream() ? connection->due() : std::nullopt;
    if (due && *due > now) wake_at(*due);
    if (due && *due <= now) connection->wake();
  }
}

void HttpServerCore::wake_streams() {
  for (const auto& connection : connections)
    if (connection->is_stream()) connection->wake();
}

}  // namespace mdof::rpc
