#include "daemon/rpc/web/http_server.h"

#include <utility>

#include "daemon/rpc/net/listener.h"
#include "daemon/rpc/web/http_server_core.h"

namespace mdof::rpc {

struct HttpServer::Impl {
  std::shared_ptr<HttpServerCore> core;
  std::vector<std::shared_ptr<Listener>> listeners;
};

HttpServer::HttpServer(EventLoop& loop, Service& service, HttpSetup setup)
    : impl_(std::make_unique<Impl>()) {
  impl_->core = std::make_shared<HttpServerCore>(loop.core(), service, std::move(setup));
}

HttpServer::~HttpServer() {
  for (const auto& listener : impl_->listeners) listener->stop();
}

Result<std::uint16_t> HttpServer::listen(const std::string& address, std::uint16_t port) {
  MDOF_TRY(Descriptor socket, listen_on_tcp(address, port));
  const std::uint16_t bound = port_of(socket.get());
  impl_->listeners.push_back(std::make_shared<Listener>(
      *impl_->core->loop, std::move(socket), [c = impl_->core.get()](int fd) { c->adopt(fd); },
      [c = impl_->core.get()](const std::string& line) { c->service.log(line); }));
  impl_->listeners.back()->start();
  return bound;
}

std::size_t HttpServer::connection_count() const {
  return impl_->core->connections.size();
}

}  // namespace mdof::rpc
