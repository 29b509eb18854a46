#include "daemon/rpc/line/server.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>
#include <vector>

#include "daemon/rpc/line/listener.h"
#include "daemon/rpc/line/server_core.h"

namespace mdof::rpc {
namespace {

// A socket file, to be removed if it is still ours.
struct SocketFile {
  std::string path;
  dev_t device = 0;
  ino_t inode = 0;
};

SocketFile socket_file(const std::string& path) {
  struct stat info {};
  (void)::lstat(path.c_str(), &info);
  return {path, info.st_dev, info.st_ino};
}

void remove(const SocketFile& file) {
  const SocketFile now = socket_file(file.path);
  if (now.device == file.device && now.inode == file.inode) (void)::unlink(file.path.c_str());
}

}  // namespace

struct Server::Impl {
  std::shared_ptr<ServerCore> core;
  std::vector<std::shared_ptr<Listener>> listeners;
  std::vector<SocketFile> files;

  void listen(Descriptor socket) {
    listeners.push_back(std::make_shared<Listener>(
        *core->loop, std::move(socket), [c = core.get()](int fd) { c->adopt(fd); },
        [c = core.get()](const std::string& line) { c->log(line); }));
    listeners.back()->start();
  }
};

Server::Server(EventLoop& loop, const MethodTable& table, ServerOptions options)
    : impl_(std::make_unique<Impl>()) {
  impl_->core = std::make_shared<ServerCore>(loop.core(), table, std::move(options));
}

Server::~Server() {
  for (const SocketFile& file : impl_->files) remove(file);
  for (const auto& listener : impl_->listeners) listener->stop();
}

Status Server::listen_unix(const std::string& path) {
  MDOF_TRY(Descriptor socket, listen_on_unix(path));
  impl_->files.push_back(socket_file(path));
  impl_->listen(std::move(socket));
  return {};
}

Status Server::listen_fd(int fd) {
  MDOF_CHECK(check_listening(fd));
  (void)::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
  (void)::fcntl(fd, F_SETFD, FD_CLOEXEC);
  impl_->listen(Descriptor(fd));
  return {};
}

Result<std::uint16_t> Server::listen_tcp(const std::string& address, std::uint16_t port) {
  MDOF_TRY(Descriptor socket, listen_on_tcp(address, port));
  const std::uint16_t bound = port_of(socket.get());
  impl_->listen(std::move(socket));
  return bound;
}

void Server::add_topic(Topic topic) {
  impl_->core->topics.add(std::move(topic));
}

std::optional<std::chrono::milliseconds> Server::wanted_every(std::string_view topic) const {
  return impl_->core->topics.wanted_every(topic);
}

Status Server::publish(std::string_view topic, std::string json) {
  return impl_->core->topics.publish(topic, std::move(json));
}

std::size_t Server::connection_count() const {
  return impl_->core->connections.size();
}

}  // namespace mdof::rpc
