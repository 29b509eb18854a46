#include "daemon/rpc/session/session.h"

#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {

Session::Session(const SessionParts& parts, Peer peer, Transport& transport)
    : parts_(parts), peer_(std::move(peer)), transport_(transport), active_(Clock::now()) {}

Session::~Session() {
  parts_.topics.forget(*this);
}

bool Session::may_write() const {
  if (over_http()) return peer_.http == Peer::Http::writes;
  return peer_.credentials.has_value() || parts_.options.tcp_may_write;
}

Status Session::subscribe(std::string_view topic, std::chrono::milliseconds interval) {
  return parts_.topics.subscribe(*this, topic, interval);
}

Status Session::unsubscribe(std::string_view topic) {
  return parts_.topics.unsubscribe(*this, topic);
}

bool Session::has_room() const {
  const auto& options = parts_.options;
  return transport_.unsent() + (open_exchanges_ + 1) * options.max_reply_bytes <=
         options.max_unsent_bytes;
}

bool Session::handle(std::string_view message, std::string& out, Clock::time_point until) {
  active_ = Clock::now();
  const Handled handled =
      parts_.dispatcher.handle(message, *this, weak_from_this(), out, batch_, until);
  open_exchanges_ += handled.open ? 1 : 0;
  return !handled.begun;
}

void Session::finish(std::string_view reply) {
  --open_exchanges_;
  active_ = Clock::now();
  if (ended_) return;
  if (!reply.empty()) transport_.send(reply);
  transport_.wake();
}

void Session::wake() {
  transport_.wake();
}

std::optional<Session::Clock::time_point> Session::send_due(Clock::time_point now) {
  return take_due(*this, now, parts_.options.max_reply_bytes,
                  [this](std::string_view message) { transport_.send(message); });
}

bool Session::has_nothing_pending() const {
  return open_exchanges_ == 0 && !batch_.exchange && subscriptions.empty();
}

bool Session::is_idle(Clock::time_point now) const {
  const auto limit = parts_.options.idle_timeout;
  return limit.count() > 0 && has_nothing_pending() && transport_.unsent() == 0 &&
         now - active_ > limit;
}

void Session::refuse(std::string_view why) {
  end_with(kInvalidRequest, "Invalid Request", why);
}

// Ends the session, so that another client can connect. If the idle client uses the closed
// connection again, it reads the reason.
void Session::end_idle() {
  end_with(kBusy,
           "the connection was idle for " +
               std::to_string(parts_.options.idle_timeout.count() / 1000) +
               " s (no request, no subscription); connect again",
           {});
}

void Session::end_with(int code, std::string_view message, std::string_view why) {
  std::string text;
  append_error(text, "null", code, message, why);
  transport_.send(text);
  end();
}

void Session::end() {
  ended_ = true;
  parts_.topics.forget(*this);
}

std::string Session::name() const {
  if (over_http()) return "browser";
  if (!peer_.credentials) return "TCP client";
  return "client with uid " + std::to_string(peer_.credentials->uid) + ", pid " +
         std::to_string(peer_.credentials->pid);
}

}  // namespace mdof::rpc
