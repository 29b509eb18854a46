// Serves the sessions of a service to browsers: the files of the page, POST /rpc for JSON-RPC
// requests, GET /events for topics as server-sent events. README.md describes the protocol.
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
  std::string token = {};               // permits writing; empty: nobody may write
  std::vector<std::string> hosts = {};  // "name:port", besides the loopback names of this machine
  std::span<const PageFile> files = page_files();
};

// Thread-bound: call it on the loop's thread, or while the loop does not run. The service and the
// loop must outlive it.
class HttpServer {
 public:
  HttpServer(EventLoop& loop, Service& service, HttpSetup setup);
  ~HttpServer();  // closes all connections
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // 127.0.0.1 or ::1; port 0: any. Returns the port.
  Result<std::uint16_t> listen(const std::string& address, std::uint16_t port);
  std::size_t connection_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
