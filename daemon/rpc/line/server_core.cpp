#include "daemon/rpc/line/server_core.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/line/peer.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

using std::chrono::milliseconds;

// Limits that contradict each other are brought into what can be kept.
ServerOptions consistent(ServerOptions o) {
  constexpr std::size_t kLeastReply = 16 * 1024;  // the longest error has room
  o.max_reply_bytes = std::max(o.max_reply_bytes, kLeastReply);
  o.max_unsent_bytes = std::max(o.max_unsent_bytes, 2 * o.max_reply_bytes);
  o.max_id_bytes = std::clamp<std::size_t>(o.max_id_bytes, 32, 1024);
  const std::size_t member = Exchange::kReserveBytes + o.max_id_bytes;
  o.max_batch = std::clamp<std::size_t>(o.max_batch, 1, o.max_reply_bytes / member - 1);
  o.max_depth = std::max<std::size_t>(o.max_depth, 4);
  o.max_connections = std::max<std::size_t>(o.max_connections, 2);
  o.requests_per_turn = std::max<std::size_t>(o.requests_per_turn, 1);
  return o;
}

// Often enough to keep a limit to within an eighth of it.
milliseconds sweep_period(const ServerOptions& o) {
  milliseconds least = std::min({o.request_timeout, o.stall_timeout, o.drain_timeout});
  if (o.idle_timeout.count() > 0) least = std::min(least, o.idle_timeout);
  return std::clamp(least / 8, milliseconds(5), milliseconds(250));
}

std::optional<uid_t> uid_of(const std::optional<Credentials>& who) {
  return who ? std::optional(who->uid) : std::nullopt;
}

std::string user_has_all(const std::optional<Credentials>& who, const ServerOptions& o) {
  return (who ? "uid " + std::to_string(who->uid) + " has " : "TCP clients have ") +
         std::to_string(o.max_connections_of_user) +
         " connections, as many as one user may have: close one, or raise connections_of_user in "
         "[rpc] of mdofd.toml";
}

std::string all_in_use(const ServerOptions& o) {
  return "all " + std::to_string(o.max_connections) + " connections are in use" +
         (o.kept_for_group ? " or kept for the group cnc_group" : "") +
         ": close one, or raise connections in [rpc] of mdofd.toml";
}

}  // namespace

ServerCore::ServerCore(std::shared_ptr<EventLoop::Core> event_loop, const MethodTable& table,
                       ServerOptions limits)
    : loop(std::move(event_loop)),
      options(consistent(std::move(limits))),
      dispatcher(loop, table, options),
      topics(options),
      sweep_timer_(*loop->context),
      due_timer_(*loop->context) {}

ServerCore::~ServerCore() {
  for (const auto& connection : std::exchange(connections, {})) connection->close();
}

// The kept place is of use only while it cannot be taken by those who have all the others.
ServerCore::Place ServerCore::place_for(int socket, std::string& why_not) const {
  const auto who = credentials_of(socket);
  const auto& group = options.kept_for_group;
  const auto of_user = [&](const auto& c) { return uid_of(c->credentials()) == uid_of(who); };
  const auto kept = [](const auto& c) { return c->has_kept_place(); };
  const auto held = std::count_if(connections.begin(), connections.end(), of_user);
  const auto in_kept = std::count_if(connections.begin(), connections.end(), kept);
  const std::size_t ordinary = connections.size() - static_cast<std::size_t>(in_kept);
  const bool user_full = static_cast<std::size_t>(held) >= options.max_connections_of_user;
  if (!user_full && ordinary < options.max_connections - (group ? 1 : 0)) return Place::ordinary;
  if (group && in_kept == 0 && is_member(socket, *group)) return Place::kept;
  why_not = user_full ? user_has_all(who, options) : all_in_use(options);
  return Place::none;
}

void ServerCore::adopt(int socket) {
  std::string why_not;
  const Place place = place_for(socket, why_not);
  if (place == Place::none) return turn_away(socket, why_not);
  told_.clear();
  connections.push_back(std::make_shared<Connection>(*this, socket, place == Place::kept));
  connections.back()->start();
  if (!std::exchange(sweeping_, true)) sweep();
}

void ServerCore::turn_away(int socket, const std::string& why) {
  std::string line;
  append_error(line, "null", kBusy, why);
  line += '\n';
  (void)::send(socket, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ::close(socket);
  if (std::exchange(told_, why) != why) log("clients are turned away: " + why);
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
  sweep_timer_.expires_after(sweep_period(options));
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
    if (!connection->subscriptions.empty()) connection->wake();
}

void ServerCore::log(const std::string& line) const {
  if (options.log)
    options.log(line);
  else
    std::fprintf(stderr, "rpc: %s\n", line.c_str());
}

}  // namespace mdof::rpc
