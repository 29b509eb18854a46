#include "daemon/rpc/net/client_socket.h"

#include <poll.h>
#include <sys/socket.h>

#include <utility>

namespace mdof::rpc {

ClientSocket::ClientSocket(asio::io_context& context, int socket) : socket_(context, socket) {}

void ClientSocket::wake() {
  if (closed_ || std::exchange(has_turn_, true)) return;
  request_turn();
}

void ClientSocket::take_turn() {
  has_turn_ = false;
  if (closed_) return;
  if (std::exchange(readable_, false)) receive();
  pump();
}

void ClientSocket::close() {
  if (std::exchange(closed_, true)) return;
  LoopError ignored;
  socket_.close(ignored);
  session_.reset();
  forget();
}

void ClientSocket::flush() {
  if (closed_) return;
  const auto sent = output_.flush(socket_.native_handle());
  if (!sent) return close();
  if (output_.unsent() == 0)
    stalled_since_.reset();
  else if (!stalled_since_ || *sent > 0)
    stalled_since_ = Clock::now();
}

void ClientSocket::wait_readable() {
  if (reading_ || input_ended_) return;
  reading_ = true;
  socket_.async_wait(asio::posix::stream_descriptor::wait_read,
                     [self = shared_from_this()](const LoopError& error) {
                       self->reading_ = false;
                       self->readable_ = true;
                       if (!error) self->wake();
                     });
}

void ClientSocket::wait_writable() {
  if (writing_) return;
  writing_ = true;
  socket_.async_wait(asio::posix::stream_descriptor::wait_write,
                     [self = shared_from_this()](const LoopError& error) {
                       self->writing_ = false;
                       if (!error) self->wake();
                     });
}

void ClientSocket::end_output() {
  if (!std::exchange(shut_down_, true)) ::shutdown(socket_.native_handle(), SHUT_WR);
}

bool ClientSocket::hung_up() {
  pollfd entry{socket_.native_handle(), 0, 0};
  return ::poll(&entry, 1, 0) > 0 && (entry.revents & (POLLHUP | POLLERR)) != 0;
}

}  // namespace mdof::rpc
