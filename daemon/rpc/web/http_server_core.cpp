#include "daemon/rpc/web/http_server_core.h"

#include <algorithm>
#include <utility>

namespace mdof::rpc {
namespace {

constexpr std::chrono::microseconds kTurns{300};

// Often enough to keep a limit to within an eighth of it.
std::chrono::milliseconds sweep_every(const ServerOptions& o) {
  const auto least = std::min(
      {o.request_timeout, o.stall_timeout, o.drain_timeout, o.http_idle_timeout, o.http_heartbeat});
  return std::clamp(least / 8, std::chrono::milliseconds(5), std::chrono::milliseconds(250));
}

}  // namespace

HttpServerCore::HttpServerCore(std::shared_ptr<EventLoop::Core> event_loop, Service& shared,
                               HttpSetup given)
    : loop(std::move(event_loop)),
      service(shared),
      setup(std::move(given)),
      files(setup.files),
      kept(std::chrono::system_clock::now(),
           {service.options().max_kept_events, service.options().max_kept_event_bytes}),
      sweep_timer_(*loop->context),
      due_timer_(*loop->context) {
  service.on_event([this](std::string_view topic, std::string_view json) {
    kept.add(topic, json);
    wake_streams();
  });
}

HttpServerCore::~HttpServerCore() {
  service.on_event(nullptr);
  for (const auto& connection : std::exchange(connections, {})) connection->close();
}

void HttpServerCore::adopt(int socket) {
  const auto connection = std::make_shared<HttpConnection>(*this, socket);
  if (connections.size() >= service.options().max_http_connections && !make_room())
    return connection->turn_away();
  connections.push_back(connection);
  connection->start();
  if (!std::exchange(sweeping_, true)) sweep();
}

// Closes what has been idle longest between two requests, as browsers expect of any server.
bool HttpServerCore::make_room() {
  std::shared_ptr<HttpConnection> oldest;
  for (const auto& connection : connections)
    if (connection->is_idle() && (!oldest || connection->since() < oldest->since()))
      oldest = connection;
  if (oldest) oldest->close();
  return oldest != nullptr;
}

void HttpServerCore::forget(const HttpConnection& connection) {
  std::erase_if(connections, [&](const auto& c) { return c.get() == &connection; });
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

void HttpServerCore::sweep() {
  for (const auto& connection : std::vector(connections)) connection->check_times(Clock::now());
  if (connections.empty()) {
    sweeping_ = false;
    return;
  }
  sweep_timer_.expires_after(sweep_every(service.options()));
  sweep_timer_.async_wait([weak = weak_from_this()](const LoopError& error) {
    if (const auto self = weak.lock(); self && !error) self->sweep();
  });
}

void HttpServerCore::ask_for_turn(std::shared_ptr<HttpConnection> connection) {
  waiting_.push_back(std::move(connection));
  post_turns();
}

void HttpServerCore::post_turns() {
  if (std::exchange(turns_posted_, true)) return;
  loop->post([weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->give_turns();
  });
}

// In slices, between which the loop looks at sockets, timers and other clients.
void HttpServerCore::give_turns() {
  turns_posted_ = false;
  const auto end = Clock::now() + kTurns;
  while (!waiting_.empty() && Clock::now() < end) {
    const auto connection = std::move(waiting_.front());
    waiting_.pop_front();
    connection->take_turn();
  }
  if (!waiting_.empty()) post_turns();
}

void HttpServerCore::wake_streams_at(Clock::time_point when) {
  if (due_ && *due_ <= when) return;
  due_ = when;
  due_timer_.expires_at(when);
  due_timer_.async_wait([weak = weak_from_this()](const LoopError& error) {
    const auto self = weak.lock();
    if (!self || error) return;  // gone, or an earlier time took its place
    self->due_.reset();
    self->wake_due_streams();
  });
}

void HttpServerCore::wake_due_streams() {
  const auto now = Clock::now();
  for (const auto& connection : connections) {
    const auto due = connection->is_stream() ? connection->due() : std::nullopt;
    if (due && *due > now) wake_streams_at(*due);
    if (due && *due <= now) connection->wake();
  }
}

void HttpServerCore::wake_streams() {
  for (const auto& connection : connections)
    if (connection->is_stream()) connection->wake();
}

}  // namespace mdof::rpc
