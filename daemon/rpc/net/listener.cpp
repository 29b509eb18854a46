#include "daemon/rpc/net/listener.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

namespace mdof::rpc {
namespace {

constexpr int kAcceptsPerTurn = 4;
constexpr auto kPause = std::chrono::milliseconds(100);

}  // namespace

Listener::Listener(EventLoop::Core& loop, Descriptor socket, std::function<void(int)> adopt,
                   std::function<void(const std::string&)> log)
    : socket_(*loop.context, socket.release()), adopt_(std::move(adopt)), log_(std::move(log)) {}

void Listener::start() {
  socket_.async_wait(asio::posix::stream_descriptor::wait_read,
                     [self = shared_from_this()](const LoopError& error) {
                       if (!error) self->accept_some();
                     });
}

void Listener::stop() {
  adopt_ = nullptr;
  LoopError ignored;
  socket_.close(ignored);
  pause_.reset();
}

void Listener::accept_some() {
  for (int i = 0; i < kAcceptsPerTurn && adopt_; ++i) {
    const int fd =
        ::accept4(socket_.native_handle(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0 && (errno == ECONNABORTED || errno == EINTR)) continue;
    if (fd < 0 && errno != EAGAIN) return pause_accepting(errno);
    if (fd < 0) break;
    const int on = 1;  // TCP only: no delay; fails on a Unix socket, where it is not needed
    (void)::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    adopt_(fd);
  }
  if (adopt_) start();
}

// Pauses if there are no free descriptors or no memory. Without the pause, the waiting client would
// wake the loop again and again.
void Listener::pause_accepting(int why) {
  log_("cannot accept a client (mdofd tries again): " + system_error_text(why));
  pause_.emplace(socket_.get_executor(), kPause);
  pause_->async_wait([self = shared_from_this()](const LoopError& error) {
    if (!error && self->adopt_) self->start();
  });
}

}  // namespace mdof::rpc
