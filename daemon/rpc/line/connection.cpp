#include "daemon/rpc/line/connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/line/server_core.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

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
  if (pump_posted_ || state_ == State::closed) return;
  pump_posted_ = true;
  server_.loop->post([self = shared_from_this()] {
    self->pump_posted_ = false;
    self->pump();
  });
}

void Connection::pump() {
  if (state_ == State::open) run_lines();
  flush();
  send_due();
  wait();
}

void Connection::run_lines() {
  std::size_t left = server_.service.options().requests_per_turn;
  while (state_ == State::open && left > 0 && session_->has_room()) {
    const auto line = input_.next();
    if (!line) return;
    line_since_.reset();
    take_line(*line, left);
  }
}

void Connection::take_line(const LineBuffer::Line& line, std::size_t& left) {
  if (line.too_long)
    return refuse("a request line may have " +
                  std::to_string(server_.service.options().max_line_bytes) + " bytes");
  if (line.text.empty()) {  // as a line end too many leaves it
    --left;
    return;
  }
  std::string& out = output_.text();  // whole lines
  left -= std::min(left, session_->handle(line.text, out));
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
  if (input_.has_line()) return wake();
  if (finished()) return close();
  if (input_.partial() && !line_since_) line_since_ = Clock::now();
  wait_readable();
}

bool Connection::finished() {
  return input_ended_ && output_.unsent() == 0 && session_->awaits_nothing();
}

// Only where no whole line waits: what next() gave has ended, and the space stays where it is.
void Connection::wait_readable() {
  if (reading_ || input_ended_) return;
  reading_ = true;
  if (state_ == State::draining) input_.discard();
  const auto space = input_.space();
  socket_.async_read_some(asio::buffer(space.data(), space.size()),
                          [self = shared_from_this()](const std::error_code& error, std::size_t n) {
                            self->reading_ = false;
                            self->received(error, n);
                          });
}

void Connection::wait_writable() {
  if (writing_) return;
  writing_ = true;
  socket_.async_wait(asio::posix::stream_descriptor::wait_write,
                     [self = shared_from_this()](const std::error_code& error) {
                       self->writing_ = false;
                       if (!error) self->pump();
                     });
}

void Connection::received(const std::error_code& error, std::size_t bytes) {
  if (state_ == State::closed) return;
  if (error && error != asio::error::eof) return close();
  input_.received(bytes);
  if (error) input_ended();
  pump();
}

void Connection::input_ended() {
  input_ended_ = true;
  if (state_ == State::draining) return close();
  if (!input_.partial()) return;
  std::string message;
  append_error(message, "null", kParseError, "Parse error",
               "the last line does not end in a line feed");
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
  std::error_code ignored;
  socket_.close(ignored);
  session_.reset();
  server_.forget(*this);
}

void Connection::check_times(Clock::time_point now) {
  const auto& options = server_.service.options();
  if (state_ == State::draining && now - draining_since_ > options.drain_timeout) return close();
  if (state_ != State::open) return;
  if (line_since_ && now - *line_since_ > options.request_timeout) {
    refuse("a request line must be complete within " +
           std::to_string(options.request_timeout.count()) + " ms");
    return pump();
  }
  if (stalled_since_ && now - *stalled_since_ > options.stall_timeout)
    return drop("it took none of " + std::to_string(output_.unsent()) + " unsent bytes for " +
                std::to_string(options.stall_timeout.count()) + " ms");
  if (input_ended_ && hung_up(socket_.native_handle())) return close();
  if (!session_->is_idle(now)) return;
  session_->end_idle();
  drain();
  pump();
}

}  // namespace mdof::rpc
