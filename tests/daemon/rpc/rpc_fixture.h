// For the tests of this folder: a server on its own thread, and a client that may violate the
// protocol.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <simdjson.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/rpc/line/server.h"
#include "daemon/rpc/net/socket.h"
#include "daemon/rpc/web/http_server.h"
#include "schema/base/json_writer.h"

namespace mdof::rpc::test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The value as JSON with sorted members and a fixed format of numbers. Two values are equal if
// these texts are equal.
inline std::string canonical(simdjson::dom::element e) {
  std::string out;
  if (simdjson::dom::array array; !e.get(array)) {
    for (const auto item : array) out += (out.empty() ? "" : ",") + canonical(item);
    return "[" + out + "]";
  }
  simdjson::dom::object object;
  if (e.get(object)) return simdjson::minify(e);
  std::vector<std::string> members;
  for (const auto [key, value] : object)
    members.push_back("\"" + std::string(key) + "\":" + canonical(value));
  std::sort(members.begin(), members.end());
  for (const std::string& member : members) out += (out.empty() ? "" : ",") + member;
  return "{" + out + "}";
}

inline std::string canonical(const std::string& text) {
  simdjson::dom::parser parser;
  simdjson::dom::element e;
  return parser.parse(text).get(e) ? "not JSON: " + text : canonical(e);
}

// The member at a path such as "/error/code", as minified JSON; empty if the member does not
// exist.
inline std::string at(const std::string& json, std::string_view path) {
  simdjson::dom::parser parser;
  simdjson::dom::element e;
  if (parser.parse(json).at_pointer(path).get(e)) return {};
  return simdjson::minify(e);
}

class RawClient {
 public:
  explicit RawClient(const std::string& path) {
    auto connected = connect_to_unix(path);
    EXPECT_TRUE(connected.has_value());
    if (connected) fd_ = std::move(*connected);
  }
  explicit RawClient(Descriptor fd) : fd_(std::move(fd)) {}

  int fd() const { return fd_.get(); }

  // Returns false if the server has closed the connection.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::send(fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }

  // Returns the next line, "<closed>" after the server has closed, or "<time out>".
  std::string line(std::chrono::milliseconds timeout = 20s) {
    for (;;) {
      if (const auto lf = text_.find('\n'); lf != std::string::npos) {
        std::string out = text_.substr(0, lf);
        text_.erase(0, lf + 1);
        return out;
      }
      pollfd entry{fd(), POLLIN, 0};
      if (::poll(&entry, 1, static_cast<int>(timeout.count())) <= 0) return "<time out>";
      char bytes[65536];
      const ssize_t n = ::recv(fd(), bytes, sizeof bytes, 0);
      if (n <= 0) return "<closed>";
      text_.append(bytes, static_cast<std::size_t>(n));
    }
  }

  std::string ask(const std::string& request) {
    send(request + "\n");
    return line();
  }

 private:
  Descriptor fd_;
  std::string text_;
};

// Adds the methods of the specification's examples and some more.
inline void add_methods(MethodTable& table) {
  using Text = Result<std::string>;
  const auto sum = [](const Params& p) -> Text {
    return std::to_string(p.integer("a") + p.integer("b") + p.integer("c"));
  };
  const std::vector<Param> numbers = {{"a", ParamType::integer, "first", false},
                                      {"b", ParamType::integer, "second", false},
                                      {"c", ParamType::integer, "third", false},
                                      {"d", ParamType::integer, "fourth", false},
                                      {"e", ParamType::integer, "fifth", false}};
  table.add({.name = "subtract",
             .summary = "Subtracts.",
             .params = {{"minuend", ParamType::integer, "from", true},
                        {"subtrahend", ParamType::integer, "what", true}},
             .result = "the difference",
             .example = R"({"minuend":42,"subtrahend":23})",
             .handler = [](const Params& p) -> Text {
               return std::to_string(p.integer("minuend") - p.integer("subtrahend"));
             }});
  for (const char* name : {"sum", "update", "notify_sum", "notify_hello"})
    table.add({.name = name,
               .summary = "Adds up.",
               .params = numbers,
               .result = "the sum",
               .handler = sum});
  table.add({.name = "get_data",
             .summary = "Gives data.",
             .result = "data",
             .handler = [](const Params&) -> Text { return R"(["hello",5])"; }});
  table.add({.name = "echo",
             .summary = "Gives back what it gets.",
             .params = {{"value", ParamType::object, "anything", true}},
             .result = "the same",
             .example = R"({"value":{}})",
             .handler = [](const Params& p) -> Text { return p.json("value"); }});
  table.add({.name = "bytes",
             .summary = "Gives a string of a length.",
             .params = {{"count", ParamType::integer, "its length", true}},
             .result = "a string",
             .example = R"({"count":1})",
             .handler = [](const Params& p) -> Text {
               return '"' + std::string(static_cast<std::size_t>(p.integer("count")), 'x') + '"';
             }});
}

class TestServer {
 public:
  explicit TestServer(ServerOptions options = {}) {
    add_methods(table);
    options.log = [this](const std::string& line) {
      const std::scoped_lock lock(log_mutex_);
      log_ += line + "\n";
    };
    service = std::make_unique<Service>(loop.executor(), table, options);
    server = std::make_unique<LineServer>(loop, *service);
    const auto status = server->listen_unix(path);
    EXPECT_TRUE(status.has_value()) << status.error().message;
  }
  ~TestServer() { stop(); }

  void start() {
    thread_ = std::thread([this] { loop.run(); });
  }
  void stop() {
    loop.stop();
    if (thread_.joinable()) thread_.join();
    server.reset();
    page.reset();
    service.reset();
  }

  // Runs `work` on the loop and returns its result.
  template <class Work>
  auto on_loop(Work work) {
    std::packaged_task<decltype(work())()> task(std::move(work));
    auto result = task.get_future();
    loop.post([&task] { task(); });
    return result.get();
  }
  std::size_t connections() {
    return on_loop([this] { return service->session_count(); });
  }
  // Waits until there are n connections; returns false after `timeout`.
  bool connections_become(std::size_t n, std::chrono::milliseconds timeout = 20s) {
    for (const auto end = Clock::now() + timeout; Clock::now() < end;
         std::this_thread::sleep_for(2ms))
      if (connections() == n) return true;
    return false;
  }
  std::string log() {
    const std::scoped_lock lock(log_mutex_);
    return log_;
  }

  std::string path = std::filesystem::temp_directory_path() /
                     ("mdof-rpc-" + std::to_string(::getpid()) + "-" + std::to_string(++count_));
  MethodTable table{"mdof test", "0.1.0"};
  EventLoop loop;
  std::unique_ptr<Service> service;
  std::unique_ptr<LineServer> server;
  std::unique_ptr<HttpServer> page;  // only if the test creates it

 private:
  static inline int count_ = 0;
  std::mutex log_mutex_;
  std::string log_;
  std::thread thread_;
};

}  // namespace mdof::rpc::test
