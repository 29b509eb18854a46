// Accepts browsers as clients of a service. It serves the files of the page, handles JSON-RPC
// requests (POST /rpc), and sends topics as server-sent events (GET /events). daemon/rpc/README.md
// describes the protocol.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "daemon/rpc/net/event_loop.h"
#include "daemon/rpc/session/service.h"
#include "daemon/rpc/web/page_files.h"
#include "schema/base/result.h"

namespace mdof::rpc {

struct HttpSetup {
  std::string token = {};  // token that permits writing; empty: no browser may write
  std::vector<std::string> hosts =
      {};  // allowed host names "name:port", in addition to the loopback names of this machine
  std::span<const PageFile> files = page_files();
};

// Thread-bound: use the server on the thread of the loop, or while the loop does not run. The
// service and the loop must exist longer than the server.
class HttpServer {
 public:
  HttpServer(EventLoop& loop, Service& service, HttpSetup setup);
  ~HttpServer();  // closes all connections
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // `address` is 127.0.0.1 or ::1. Port 0 selects a free port. Returns the port.
  Result<std::uint16_t> listen(const std::string& address, std::uint16_t port);
  std::size_t connection_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
