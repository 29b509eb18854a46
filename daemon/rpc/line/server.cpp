#include "daemon/rpc/line/server.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>
#include <vector>

#include "daemon/rpc/line/server_core.h"
#include "daemon/rpc/net/listener.h"

namespace mdof::rpc {
namespace {

// A socket file. At its end, the server removes this file if the path still leads to the same file.
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

struct LineServer::Impl {
  std::shared_ptr<ServerCore> core;
  std::vector<std::shared_ptr<Listener>> listeners;
  std::vector<SocketFile> files;

  void listen(Descriptor socket) {
    listeners.push_back(std::make_shared<Listener>(
        *core->loop, std::move(socket), [c = core.get()](int fd) { c->adopt(fd); },
        [c = core.get()](const std::string& line) { c->service.log(line); }));
    listeners.back()->start();
  }
};

LineServer::LineServer(EventLoop& loop, Service& service) : impl_(std::make_unique<Impl>()) {
  impl_->core = std::make_shared<ServerCore>(loop.core(), service);
}

LineServer::~LineServer() {
  for (const SocketFile& file : impl_->files) remove(file);
  for (const auto& listener : impl_->listeners) listener->stop();
}

Status LineServer::listen_unix(const std::string& path) {
  MDOF_TRY(Descriptor socket, listen_on_unix(path));
  impl_->files.push_back(socket_file(path));
  impl_->listen(std::move(socket));
  return {};
}

Status LineServer::listen_fd(int fd) {
  MDOF_CHECK(check_listening(fd));
  (void)::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
  (void)::fcntl(fd, F_SETFD, FD_CLOEXEC);
  impl_->listen(Descriptor(fd));
  return {};
}

Result<std::uint16_t> LineServer::listen_tcp(const std::string& address, std::uint16_t port) {
  MDOF_TRY(Descriptor socket, listen_on_tcp(address, port));
  const std::uint16_t bound = port_of(socket.get());
  impl_->listen(std::move(socket));
  return bound;
}

}  // namespace mdof::rpc
