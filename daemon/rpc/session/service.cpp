#include "daemon/rpc/session/service.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "schema/base/output/printable.h"

namespace mdof::rpc {
namespace {

// Increases limits that are too small to work together.
ServerOptions consistent(ServerOptions o) {
  constexpr std::size_t kLeastReply = 16 * 1024;  // enough for the longest error message
  o.max_reply_bytes = std::max(o.max_reply_bytes, kLeastReply);
  o.max_unsent_bytes = std::max(o.max_unsent_bytes, 2 * o.max_reply_bytes);
  o.max_id_bytes = std::clamp<std::size_t>(o.max_id_bytes, 32, 1024);
  const std::size_t member = Exchange::kReserveBytes + o.max_id_bytes;
  o.max_batch = std::clamp<std::size_t>(o.max_batch, 1, o.max_reply_bytes / member - 1);
  o.max_depth = std::max<std::size_t>(o.max_depth, 4);
  o.max_connections = std::max<std::size_t>(o.max_connections, 2);
  return o;
}

std::optional<uid_t> uid_of(const Peer& peer) {
  return peer.credentials ? std::optional(peer.credentials->uid) : peer.socket_owner;
}

std::string user_has_all(const Peer& peer, const ServerOptions& o) {
  const auto uid = uid_of(peer);
  return (uid ? "uid " + std::to_string(*uid) + " has " : "TCP clients have ") +
         std::to_string(o.max_connections_of_user) +
         " connections (limit for one user); close a connection, or raise connections_of_user in "
         "[rpc] of mdofd.toml";
}

std::string all_in_use(const ServerOptions& o) {
  return "all " + std::to_string(o.max_connections) + " connections are in use" +
         (o.kept_for_group ? " (some are reserved for the group in cnc_group)" : "") +
         "; close a connection, or raise \"connections\" in [rpc] of mdofd.toml";
}

}  // namespace

Service::Service(std::shared_ptr<Executor> loop, const MethodTable& table, ServerOptions options)
    : options_(consistent(std::move(options))),
      dispatcher_(std::move(loop), table, options_),
      topics_(options_) {}

// The kind of place that a new client gets; each kind has its own limit. A client in the group
// kept_for_group gets the reserved place only if all ordinary places are in use. Browsers do not
// use these places, so that browsers cannot exclude the machine's control; HttpServer limits their
// number.
Result<Service::Place> Service::place_for(const Peer& peer) const {
  if (peer.http != Peer::Http::no) return Place::http;
  std::size_t of_user = 0, ordinary = 0, kept = 0;
  for (const auto& [weak, place] : holders_) {
    const auto session = weak.lock();
    if (!session || place == Place::http) continue;
    of_user += uid_of(session->peer()) == uid_of(peer) ? 1 : 0;
    ++(place == Place::kept ? kept : ordinary);
  }
  const auto& group = options_.kept_for_group;
  const bool user_full = of_user >= options_.max_connections_of_user;
  if (!user_full && ordinary < options_.max_connections - (group ? 1 : 0)) return Place::ordinary;
  if (group && kept == 0 && peer.is_member(*group)) return Place::kept;
  return fail(ErrorCode::conflict, user_full ? user_has_all(peer, options_) : all_in_use(options_));
}

Result<std::shared_ptr<Session>> Service::admit(Peer peer, Transport& transport) {
  std::erase_if(holders_, [](const Holder& holder) { return holder.session.expired(); });
  const auto place = place_for(peer);
  if (!place) {
    const std::string& why = place.error().message;
    if (std::exchange(last_refusal_, why) != why) log("a client was refused: " + why);
    return tl::unexpected(place.error());
  }
  last_refusal_.clear();
  auto session = std::make_shared<Session>(SessionParts{dispatcher_, topics_, options_},
                                           std::move(peer), transport);
  holders_.push_back({session, *place});
  return session;
}

std::size_t Service::session_count() const {
  return static_cast<std::size_t>(
      std::count_if(holders_.begin(), holders_.end(),
                    [](const Holder& holder) { return !holder.session.expired(); }));
}

std::vector<std::string> Service::clients() const {
  std::vector<std::string> names;
  for (const Holder& holder : holders_)
    if (const auto session = holder.session.lock()) names.push_back(session->name());
  return names;
}

void Service::add_topic(Topic topic) {
  topics_.add(std::move(topic));
}

std::optional<std::chrono::milliseconds> Service::wanted_interval(std::string_view topic) const {
  return topics_.wanted_interval(topic);
}

Status Service::publish(std::string_view topic, std::string json, std::string_view of) {
  const Topic* const known = topics_.topic(topic);
  if (event_listener_ && known && known->event && topics_.fits(topic, json))
    event_listener_(topic, json);
  return topics_.publish(topic, std::move(json), of);
}

void Service::log(const std::string& line) const {
  if (options_.log)
    options_.log(line);
  else
    std::fprintf(stderr, "rpc: %s\n", printable(line).c_str());
}

}  // namespace mdof::rpc
