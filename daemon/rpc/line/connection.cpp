#include "daemon/rpc/line/connection.h"

#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/line/server_core.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

// Whether the line is a request line or a header field of HTTP. A page in a browser can send HTTP
// and then lines of its own; these lines must not be handled as requests. No valid request begins
// in this way.
bool is_http(std::string_view line) {
  constexpr std::string_view kToken =
      "!#$%&'*+-.^_`|~0123456789"
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  const auto end = line.find_first_not_of(kToken);
  if (end == 0 || end == std::string_view::npos) return false;
  return line[end] == ':' || (line[end] == ' ' && line.find(" HTTP/", end) != line.npos) ||
         (line[end] == ' ' && line.substr(end + 1).starts_with('/'));
}

}  // namespace

Connection::Connection(ServerCore& server, int socket)
    : ClientSocket(*server.loop->context, socket),
      server_(server),
      input_(server.service.options().max_line_bytes, Dispatcher::kPadding) {}

void Connection::start(std::shared_ptr<Session> session) {
  session_ = std::move(session);
  wait_readable();
}

void Connection::reject_connection(std::string_view why) {
  std::string message;
  append_error(message, "null", kBusy, why);
  send(message);
  (void)output_.flush(socket_.native_handle());
  close();
}

void Connection::send(std::string_view message) {
  output_.text().append(message).push_back('\n');
}

void Connection::request_turn() {
  server_.request_turn(std::static_pointer_cast<Connection>(shared_from_this()));
}

void Connection::forget() {
  server_.forget(*this);
}

void Connection::pump() {
  if (is_open()) run_lines();
  send_all();
}

void Connection::send_all() {
  flush();
  send_due();
  wait();
}

// Handles requests until the turn ends, but at least one request, so that even the shortest turn
// makes progress.
void Connection::run_lines() {
  const auto until = Clock::now() + server_.service.options().turn;
  while (is_open() && session_->has_room() && next_line()) {
    take_line(until);
    if (Clock::now() > until) return;
  }
}

bool Connection::next_line() {
  if (!line_) line_ = input_.next();
  return line_.has_value();
}

void Connection::take_line(Clock::time_point until) {
  line_since_.reset();
  const auto line = *std::exchange(line_, std::nullopt);
  if (line.too_long)
    return refuse("the request line is too long (limit " +
                  std::to_string(server_.service.options().max_line_bytes) + " bytes)");
  if (!session_->peer().credentials && is_http(line.text))
    return refuse(
        "this port accepts JSON-RPC lines, not HTTP; for HTTP use the address of the web page "
        "([http] of mdofd.toml)");
  if (line.text.empty()) return;      // an empty line
  std::string& out = output_.text();  // output_ contains complete lines only
  if (!session_->handle(line.text, out, until)) line_ = line;
  if (!out.empty() && out.back() != '\n') out += '\n';
}

// Sends due notifications as long as the socket accepts data. The other notifications wait until
// the socket can be written, or until they are due.
void Connection::send_due() {
  while (is_open() && output_.unsent() == 0 && session_->has_subscriptions()) {
    const auto next = session_->send_due(Clock::now());
    if (next) server_.wake_at(*next);
    if (output_.unsent() == 0) return;
    flush();
  }
}

// Decides what the connection does next: write, take another turn, close, or read.
void Connection::wait() {
  if (closed_) return;
  if (output_.unsent() > 0) wait_writable();
  if (draining_since_) {
    if (output_.unsent() == 0) end_output();
    return wait_readable();
  }
  if (!session_->has_room())
    return line_since_.reset();  // the line waits until the client has read its replies; this is
                                 // not limited by request_timeout
  if (line_ || input_.has_line()) return go_on();
  if (finished()) return close();
  if (input_.partial() && !line_since_) line_since_ = Clock::now();
  wait_readable();
}

// Continues after a turn. A client that has closed both directions reads no reply, and its
// connection is closed. Its last messages (notifications) have had one turn; messages that did not
// fit into this turn are not handled.
void Connection::go_on() {
  hung_up() ? close() : wake();
}

bool Connection::finished() {
  return input_ended_ && output_.unsent() == 0 && session_->has_nothing_pending();
}

// Call this function only if no complete line is in the buffer, because receiving makes the result
// of LineBuffer::next() invalid.
void Connection::receive() {
  if (draining_since_) input_.discard();
  const auto space = input_.space();
  const ssize_t got = ::recv(socket_.native_handle(), space.data(), space.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;  // no data now
  if (got < 0) return close();
  input_.received(static_cast<std::size_t>(got));
  if (got == 0) input_ended();
}

void Connection::input_ended() {
  input_ended_ = true;
  if (draining_since_) return close();
  if (!input_.partial()) return;
  std::string message;
  append_error(message, "null", kParseError, "Parse error",
               "the last line does not end with a line feed");
  send(message);
}

// Sends the reason, waits until the client has read the reason, and closes the connection. During
// this time input is discarded, because the kernel also discards unsent output when a socket with
// unread input is closed.
void Connection::refuse(std::string_view why) {
  session_->refuse(why);
  server_.service.log(session_->name() + " refused: " + std::string(why));
  drain();
}

void Connection::drain() {
  draining_since_ = Clock::now();
}

void Connection::drop(const std::string& why) {
  server_.service.log(session_->name() + " dropped: " + why);
  close();
}

void Connection::check_times(Clock::time_point now) {
  const auto& options = server_.service.options();
  if (draining_since_ && now - *draining_since_ > options.drain_timeout) return close();
  if (!is_open()) return;
  if (line_since_ && now - *line_since_ > options.request_timeout) {
    refuse("the request line was not complete within " +
           std::to_string(options.request_timeout.count()) + " ms");
    return send_all();
  }
  if (stalled_since_ && now - *stalled_since_ > options.stall_timeout)
    return drop("the client has accepted no data for " +
                std::to_string(options.stall_timeout.count()) +
                " ms (bytes not sent: " + std::to_string(output_.unsent()) + ")");
  if ((input_ended_ || !reading_) && !has_turn_ && hung_up()) return close();
  if (!session_->is_idle(now)) return;
  session_->end_idle();
  drain();
  send_all();
}

}  // namespace mdof::rpc
