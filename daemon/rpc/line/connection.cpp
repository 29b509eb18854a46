#include "daemon/rpc/line/connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/line/server_core.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

// A request line or a header: a page in a browser can send them with lines of its own behind them,
// which must not be run. No request of ours begins so.
bool is_http(std::string_view line) {
  constexpr std::string_view kToken =
      "!#$%&'*+-.^_`|~0123456789"
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  const auto end = line.find_first_not_of(kToken);
  if (end == 0 || end == std::string_view::npos) return false;
  return line[end] == ':' || (line[end] == ' ' && line.find(" HTTP/", end) != line.npos) ||
         (line[end] == ' ' && line.substr(end + 1).starts_with('/'));
}

bool hung_up(int socket) {
  pollfd entry{socket, 0, 0};
  return ::poll(&entry, 1, 0) > 0 && (entry.revents & (POLLHUP | POLLERR)) != 0;
}

}  // namespace

Connection::Connection(ServerCore& server, int socket)
    : server_(server),
      socket_(*server.loop->context, socket),
      input_(server.service.options().max_line_bytes, Dispatcher::kPadding) {}

void Connection::start(std::shared_ptr<Session> session) {
  session_ = std::move(session);
  wait_readable();
}

void Connection::turn_away(std::string_view why) {
  std::string message;
  append_error(message, "null", kBusy, why);
  send(message);
  (void)output_.flush(socket_.native_handle());
  close();
}

void Connection::send(std::string_view message) {
  output_.text().append(message).push_back('\n');
}

void Connection::wake() {
  if (state_ == State::closed || std::exchange(has_turn_, true)) return;
  server_.ask_for_turn(shared_from_this());
}

void Connection::take_turn() {
  has_turn_ = false;
  if (state_ == State::closed) return;
  if (std::exchange(readable_, false)) receive();
  if (state_ == State::open) run_lines();
  pump();
}

void Connection::pump() {
  flush();
  send_due();
  wait();
}

// At least one request or member of a batch, so that it goes on however short a turn is.
void Connection::run_lines() {
  const auto until = Clock::now() + server_.service.options().turn;
  while (state_ == State::open && session_->has_room() && next_line()) {
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
  if (line.text.empty()) return;      // as a line end too many leaves it
  std::string& out = output_.text();  // whole lines
  if (!session_->handle(line.text, out, until)) line_ = line;
  if (!out.empty() && out.back() != '\n') out += '\n';
}

void Connection::flush() {
  if (state_ == State::closed) return;
  const auto sent = output_.flush(socket_.native_handle());
  if (!sent) return close();
  if (output_.unsent() == 0)
    stalled_since_.reset();
  else if (!stalled_since_ || *sent > 0)
    stalled_since_ = Clock::now();
}

// As long as the client takes it: what is left waits for the socket, or for its time.
void Connection::send_due() {
  while (state_ == State::open && output_.unsent() == 0 && session_->has_subscriptions()) {
    const auto next = session_->send_due(Clock::now());
    if (next) server_.wake_subscribers_at(*next);
    if (output_.unsent() == 0) return;
    flush();
  }
}

// Exactly one thing comes next: writing, another turn, the end, or reading.
void Connection::wait() {
  if (state_ == State::closed) return;
  if (output_.unsent() > 0) wait_writable();
  if (state_ == State::draining) {
    if (output_.unsent() == 0 && !std::exchange(shut_down_, true))
      ::shutdown(socket_.native_handle(), SHUT_WR);
    return wait_readable();
  }
  if (!session_->has_room())
    return line_since_.reset();  // the line waits for us, not we for the line
  if (line_ || input_.has_line()) return go_on();
  if (finished()) return close();
  if (input_.partial() && !line_since_) line_since_ = Clock::now();
  wait_readable();
}

// A client that has closed both ways takes no reply any more: what it sent last, as a notification,
// has had its turn, and what does not fit into that is not run.
void Connection::go_on() {
  hung_up(socket_.native_handle()) ? close() : wake();
}

bool Connection::finished() {
  return input_ended_ && output_.unsent() == 0 && session_->awaits_nothing();
}

// Only where no whole line waits: what next() gave has ended, and the space stays where it is.
void Connection::wait_readable() {
  if (reading_ || input_ended_) return;
  reading_ = true;
  socket_.async_wait(asio::posix::stream_descriptor::wait_read,
                     [self = shared_from_this()](const LoopError& error) {
                       self->reading_ = false;
                       self->readable_ = true;
                       if (!error) self->wake();
                     });
}

void Connection::wait_writable() {
  if (writing_) return;
  writing_ = true;
  socket_.async_wait(asio::posix::stream_descriptor::wait_write,
                     [self = shared_from_this()](const LoopError& error) {
                       self->writing_ = false;
                       if (!error) self->wake();
                     });
}

void Connection::receive() {
  if (state_ == State::draining) input_.discard();
  const auto space = input_.space();
  const ssize_t got = ::recv(socket_.native_handle(), space.data(), space.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;  // waits again
  if (got < 0) return close();
  input_.received(static_cast<std::size_t>(got));
  if (got == 0) input_ended();
}

void Connection::input_ended() {
  input_ended_ = true;
  if (state_ == State::draining) return close();
  if (!input_.partial()) return;
  std::string message;
  append_error(message, "null", kParseError, "Parse error",
               "the last line does not end with a line feed");
  send(message);
}

// Says why, lets the client take it, closes. What it still sends is thrown away meanwhile, for a
// socket closed with unread bytes would take the answer with it.
void Connection::refuse(std::string_view why) {
  session_->refuse(why);
  server_.service.log(session_->name() + " refused: " + std::string(why));
  drain();
}

void Connection::drain() {
  state_ = State::draining;
  draining_since_ = Clock::now();
}

void Connection::drop(const std::string& why) {
  server_.service.log(session_->name() + " dropped: " + why);
  close();
}

void Connection::close() {
  if (state_ == State::closed) return;
  state_ = State::closed;
  LoopError ignored;
  socket_.close(ignored);
  session_.reset();
  server_.forget(*this);
}

void Connection::check_times(Clock::time_point now) {
  const auto& options = server_.service.options();
  if (state_ == State::draining && now - draining_since_ > options.drain_timeout) return close();
  if (state_ != State::open) return;
  if (line_since_ && now - *line_since_ > options.request_timeout) {
    refuse("the request line was not complete within " +
           std::to_string(options.request_timeout.count()) + " ms");
    return pump();
  }
  if (stalled_since_ && now - *stalled_since_ > options.stall_timeout)
    return drop("the client accepted none of " + std::to_string(output_.unsent()) +
                " unsent bytes for " + std::to_string(options.stall_timeout.count()) + " ms");
  if ((input_ended_ || !reading_) && !has_turn_ && hung_up(socket_.native_handle())) return close();
  if (!session_->is_idle(now)) return;
  session_->end_idle();
  drain();
  pump();
}

}  // namespace mdof::rpc
