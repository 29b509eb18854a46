#include "daemon/rpc/web/http_connection.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "daemon/rpc/message.h"
#include "daemon/rpc/net/peer.h"
#include "daemon/rpc/web/events/event_query.h"
#include "daemon/rpc/web/http_server_core.h"
#include "daemon/rpc/web/same_site.h"
#include "daemon/rpc/web/token.h"

namespace mdof::rpc {
namespace {

constexpr std::size_t kReceiveBytes = 16 * 1024;

}  // namespace

HttpConnection::HttpConnection(HttpServerCore& server, int socket)
    : ClientSocket(*server.loop->context, socket), server_(server), peer_(peer_of(socket)) {}

void HttpConnection::reject_connection() {
  append_refusal(output_.text(),
                 {503,
                  "all connections of mdofd for browsers are in use; close a browser tab that "
                  "shows mdofd"},
                 "Retry-After: 5\r\n");
  (void)output_.flush(socket_.native_handle());
  close();
}

// Receives a reply that comes later, or, on a stream, a notification, which becomes an event.
void HttpConnection::send(std::string_view message) {
  if (!is(State::streaming)) {
    reply_ = message;
    return;
  }
  const Notification note = parse_notification(message);
  append_event(output_.text(), seen_, note.method, note.params);
}

void HttpConnection::request_turn() {
  server_.request_turn(std::static_pointer_cast<HttpConnection>(shared_from_this()));
}

void HttpConnection::forget() {
  server_.forget(*this);
}

void HttpConnection::pump() {
  flush();
  if (is(State::reading) && output_.unsent() == 0) take_request();
  if (is(State::answering)) continue_rpc();
  flush();
  send_stream();
  wait();
}

void HttpConnection::take_request() {
  if (input_.empty() || (!head_ && !take_head())) return;
  if (input_.size() - body_at_ >= head_->body_bytes) answer();
}

// Reads the head of a request. False: the head is incomplete or was rejected.
bool HttpConnection::take_head() {
  const auto& options = server_.service.options();
  const auto end = head_length(input_, scanned_, options.max_http_head_bytes);
  if (!end) return refuse(end.error()), false;
  if (*end == 0) return false;
  auto head = read_head(std::string_view(input_).substr(0, *end),
                        {options.max_http_head_bytes, options.max_line_bytes});
  if (!head) return refuse(head.error()), false;
  head_ = std::move(*head);
  body_at_ = *end;
  since_ = Clock::now();
  if (const auto fit = judge(); !fit)
    return refuse(fit.error(), fit.error().status == 405 ? server_.allowed(head_->path) : ""),
           false;
  if (head_->expects_continue && input_.size() - body_at_ < head_->body_bytes)
    output_.text() += "HTTP/1.1 100 Continue\r\n\r\n";
  return true;
}

// Checks a request before its body arrives.
tl::expected<void, HttpError> HttpConnection::judge() const {
  MDOF_CHECK(check_same_site(*head_, server_.setup.hosts));
  const bool rpc = head_->path == "/rpc", stream = head_->path == "/events";
  const bool reads = head_->method == "GET" || (head_->method == "HEAD" && !stream);
  if (!rpc && !stream && server_.files.find(head_->path) == nullptr)
    return tl::unexpected(HttpError{404, "this page does not exist"});
  if (rpc ? head_->method != "POST" : !reads)
    return tl::unexpected(HttpError{
        405, head_->path +
                 " does not accept this HTTP method; the header Allow lists the accepted methods"});
  if (!rpc && head_->body_bytes > 0)
    return tl::unexpected(HttpError{400, "a request for this path must not have a body"});
  const std::string_view type =
      std::string_view(head_->content_type).substr(0, head_->content_type.find(';'));
  if (rpc && type != "application/json")
    return tl::unexpected(HttpError{415, "Content-Type must be application/json"});
  return {};
}

void HttpConnection::answer() {
  if (head_->path == "/rpc") return begin_rpc();
  if (head_->path == "/events") return begin_stream();
  send_file();
}

bool HttpConnection::admit(Peer::Http right) {
  Peer peer = peer_;
  peer.http = right;
  auto session = server_.service.admit(std::move(peer), *this);
  if (!session) return refuse({503, session.error().message}), false;
  session_ = std::move(*session);
  return true;
}

void HttpConnection::begin_rpc() {
  const bool writes = bears_token(head_->authorization, server_.setup.token);
  if (!admit(writes ? Peer::Http::writes : Peer::Http::reads)) return;
  state_ = State::answering;
  calling_ = true;
}

// Continues a call. A batch may need several turns.
void HttpConnection::continue_rpc() {
  if (calling_) {
    std::string out;
    const std::size_t size = input_.size();
    input_.append(Dispatcher::kPadding, '\0');
    calling_ = !session_->handle({input_.data() + body_at_, head_->body_bytes}, out,
                                 Clock::now() + server_.service.options().turn);
    input_.resize(size);
    if (calling_) return wake();
    if (!out.empty()) reply_ = std::move(out);
  }
  if (reply_) {
    const std::string text = *std::exchange(reply_, std::nullopt);
    return reply(
        {.type = "application/json", .body = text, .fields = "Cache-Control: no-store\r\n"});
  }
  if (session_->has_nothing_pending()) reply({.status = 204});  // all requests are notifications
}

void HttpConnection::begin_stream() {
  if (server_.stream_count() >= server_.service.options().max_http_streams)
    return refuse({503,
                   "all event streams of mdofd are in use; close a browser tab that shows "
                   "mdofd"},
                  "Retry-After: 5\r\n");
  if (!admit(Peer::Http::reads)) return;
  if (const auto error = subscribe_all()) return refuse(*error);
  const auto resumed = server_.kept.resume(head_->last_event_id);
  seen_ = resumed.after;
  // Limits the data that waits in the kernel, because this data would be old when it is sent.
  const int bytes = 128 * 1024;
  (void)::setsockopt(socket_.native_handle(), SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
  append_stream_head(output_.text());
  output_.text() += "retry: 2000\nid: " + std::to_string(seen_) + "\n\n";
  if (resumed.lost && !events_.empty())
    append_event(output_.text(), seen_, "lost",
                 "{\"count\":" + (resumed.count ? std::to_string(*resumed.count) : "null") + "}");
  state_ = State::streaming;
  sent_ = Clock::now();
  input_.clear();
}

std::optional<HttpError> HttpConnection::subscribe_all() {
  const auto asked = read_event_query(head_->query);
  if (!asked) return asked.error();
  for (const std::string& name : asked->topics) {
    if (const Topic* topic = server_.service.topic(name); topic && topic->event) {
      events_.push_back(name);
      continue;
    }
    const Status done = session_->subscribe(name, asked->interval);
    if (!done)
      return HttpError{done.error().code == ErrorCode::not_found ? 404 : 400, done.error().message};
  }
  return std::nullopt;
}

void HttpConnection::send_file() {
  const ServedFile& file = *server_.files.find(head_->path);
  const bool gzip = head_->takes_gzip && !file.gzip.empty();
  const std::string& etag = gzip ? file.etag_gzip : file.etag;
  std::string fields = "ETag: " + etag + "\r\nCache-Control: no-cache\r\nVary: Accept-Encoding\r\n";
  if (head_->if_none_match.find(etag) != std::string::npos)
    return reply({.status = 304, .fields = fields});
  if (gzip) fields += "Content-Encoding: gzip\r\n";
  reply({.type = file.type,
         .body = gzip ? std::string_view(file.gzip) : file.text,
         .fields = fields,
         .head_only = head_->method == "HEAD"});
}

void HttpConnection::reply(const HttpReply& reply) {
  HttpReply said = reply;
  said.keep_alive = head_->keep_alive;
  append_http_reply(output_.text(), said);
  request_ends(head_->keep_alive);
}

// Sends the reason, waits until the client has read the reason, and closes the connection. During
// this time input is discarded.
void HttpConnection::refuse(const HttpError& error, std::string fields) {
  append_refusal(output_.text(), error, std::move(fields));
  request_ends(false);
}

void HttpConnection::request_ends(bool keep_alive) {
  session_.reset();
  events_.clear();
  if (!keep_alive) return drain();
  input_.erase(0, body_at_ + head_->body_bytes);
  head_.reset();
  scanned_ = body_at_ = 0;
  state_ = State::reading;
  since_ = Clock::now();
}

void HttpConnection::drain() {
  state_ = State::draining;
  since_ = Clock::now();
  input_.clear();
}

void HttpConnection::send_events() {
  const std::size_t most = server_.service.options().max_reply_bytes;
  while (!events_.empty() && output_.unsent() < most) {
    const auto [event, lost] = server_.kept.next(seen_);
    if (lost > 0) {
      seen_ += lost;
      append_event(output_.text(), seen_, "lost", "{\"count\":" + std::to_string(lost) + "}");
      continue;
    }
    if (event == nullptr) return;
    seen_ = event->id;
    if (std::find(events_.begin(), events_.end(), event->topic) != events_.end())
      append_event(output_.text(), seen_, event->topic,
                   R"({"missed":0,"value":)" + event->json + '}');
  }
}

// Sends events and due values as long as the socket accepts data. The other values wait until the
// socket can be written, or until they are due.
void HttpConnection::send_stream() {
  while (is(State::streaming) && output_.unsent() == 0) {
    send_events();
    due_ = session_->send_due(Clock::now());
    if (due_) server_.wake_at(*due_);
    if (output_.unsent() == 0) return;
    sent_ = Clock::now();
    flush();
  }
}

void HttpConnection::wait() {
  if (closed_) return;
  if (output_.unsent() > 0) wait_writable();
  if (is(State::draining) && output_.unsent() == 0) end_output();
  if (is(State::answering)) return;  // the reply is not known yet
  if (is(State::reading)) {
    if (output_.unsent() > 0) return;
    if (input_ended_) return close();
    // The next request was received already.
    if (!input_.empty() && !head_ && scanned_ == 0) return wake();
  }
  wait_readable();
}

void HttpConnection::receive() {
  char bytes[kReceiveBytes];
  const ssize_t got = ::recv(socket_.native_handle(), bytes, sizeof bytes, MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;  // no data now
  if (got < 0) return close();
  if (got == 0) {
    input_ended_ = true;
    if (is(State::draining) || is(State::streaming)) close();
    return;
  }
  if (is(State::draining) || is(State::streaming))
    return;  // the connection expects no input; discard it
  if (input_.empty()) since_ = Clock::now();
  input_.append(bytes, static_cast<std::size_t>(got));
}

void HttpConnection::drop(const std::string& why) {
  server_.service.log("browser dropped: " + why);
  close();
}

void HttpConnection::check_times(Clock::time_point now) {
  const auto& options = server_.service.options();
  if (stalled_since_ && now - *stalled_since_ > options.stall_timeout)
    return drop("the browser has accepted no data for " +
                std::to_string(options.stall_timeout.count()) +
                " ms (bytes not sent: " + std::to_string(output_.unsent()) + ")");
  const auto passed = now - since_;
  if (is(State::draining) && passed > options.drain_timeout) return close();
  if (is(State::answering) && hung_up()) return close();
  if (is(State::streaming) && output_.unsent() == 0 && now - sent_ > options.http_heartbeat) {
    output_.text() += ":\n\n";
    sent_ = now;
    pump();
  }
  if (!is(State::reading) || output_.unsent() > 0) return;
  if (is_idle() && passed > options.http_idle_timeout) return close();
  if (is_idle() || passed <= options.request_timeout) return;
  refuse({408, "the request was not complete within " +
                   std::to_string(options.request_timeout.count()) + " ms"});
  pump();
}

}  // namespace mdof::rpc
