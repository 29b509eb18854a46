#include "daemon/rpc/net/outbox.h"

#include <sys/socket.h>

#include <cerrno>

namespace mdof::rpc {
namespace {

// A buffer with more bytes than this is released when it is empty.
constexpr std::size_t kKeepCapacity = 128 * 1024;

}  // namespace

std::optional<std::size_t> Outbox::flush(int socket) {
  std::size_t total = 0;
  while (unsent() > 0) {
    const ssize_t n = ::send(socket, text_.data() + sent_, unsent(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != EAGAIN) return std::nullopt;
    if (n < 0) break;
    sent_ += static_cast<std::size_t>(n);
    total += static_cast<std::size_t>(n);
  }
  forget_sent();
  return total;
}

void Outbox::forget_sent() {
  if (sent_ == text_.size()) {
    text_.clear();
    if (text_.capacity() > kKeepCapacity) text_.shrink_to_fit();
    sent_ = 0;
  } else if (sent_ > text_.size() / 2) {
    text_.erase(0, sent_);
    sent_ = 0;
  }
}

}  // namespace mdof::rpc
