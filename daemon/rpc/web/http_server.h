// The sessions of a service for browsers: the files of the page, POST /rpc for requests of
// JSON-RPC, GET /events for topics as server-sent events. README.md has the rules of the wire.
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
  std::string token = {};               // of those who may write; empty: nobody
  std::vector<std::string> hosts = {};  // "name:port", beside the names of this machine's loopback
  std::span<const PageFile> files = page_files();
};

// Thread-bound: every call on the loop's thread, or while the loop does not run. The service
// outlives it, and so does the loop.
class HttpServer {
 public:
  HttpServer(EventLoop& loop, Service& service, HttpSetup setup);
  ~HttpServer();  // closes all connections
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // 127.0.0.1 or ::1; port 0: any. Gives the port.
  Result<std::uint16_t> listen(const std::string& address, std::uint16_t port);
  std::size_t connection_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::rpc
