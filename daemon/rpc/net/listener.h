// Accepts clients on one listening socket. Private header.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/net/socket.h"

namespace mdof::rpc {

// Thread-bound to the event loop.
class Listener : public std::enable_shared_from_this<Listener> {
 public:
  // Passes each connected, non-blocking socket to `adopt`, which then owns it.
  Listener(EventLoop::Core& loop, Descriptor socket, std::function<void(int)> adopt,
           std::function<void(const std::string&)> log);

  void start();
  void stop();

 private:
  void accept_some();
  void pause_accepting(int why);

  asio::posix::stream_descriptor socket_;
  std::optional<asio::steady_timer> pause_;
  std::function<void(int)> adopt_;
  std::function<void(const std::string&)> log_;
};

}  // namespace mdof::rpc
