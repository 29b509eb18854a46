// For the tests of this folder: a server of the web page, and a client that may violate the
// protocol.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>

#include <array>

#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {

inline constexpr std::array<PageFile, 2> kTestPage{{
    {"index.html", "<!doctype html><title>test</title>"},
    {"app.js",
     "// 0123456789012345678901234567890123456789012345678901234567890123456789"
     "0123456789012345678901234567890123456789012345678901234567890123456789\n"},
}};
inline const std::string kTestToken(64, 'a');

struct Answer {
  int status = 0;  // 0: the server closed without an answer, or the answer came too late
  std::string head, body;

  // The value of a header field; "" if the field is missing.
  std::string field(const std::string& name) const {
    const auto at = head.find("\r\n" + name + ": ");
    if (at == std::string::npos) return {};
    const auto begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
  }
};

class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }

  int fd() const { return fd_.get(); }

  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::send(fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }

  // Reads until `text` arrives. Returns all bytes up to the end of `text`, or "" if the server
  // closes or sends nothing.
  std::string until(std::string_view text, std::chrono::milliseconds timeout = 20s) {
    for (;;) {
      if (const auto at = got_.find(text); at != std::string::npos) {
        std::string out = got_.substr(0, at + text.size());
        got_.erase(0, out.size());
        return out;
      }
      if (!receive(timeout)) return {};
    }
  }

  Answer answer(bool of_head = false) {
    Answer out;
    out.head = until("\r\n\r\n");
    if (out.head.size() < 12) return out;
    out.status = std::atoi(out.head.c_str() + 9);
    const auto bytes = out.field("Content-Length");
    const std::size_t most = bytes.empty() || of_head ? 0 : std::stoul(bytes);
    while (got_.size() < most)
      if (!receive(20s)) break;
    out.body = got_.substr(0, most);
    got_.erase(0, most);
    return out;
  }

  Answer ask(const std::string& request) {
    send(request);
    return answer();
  }

  // Returns true if the server closes the connection without sending further bytes.
  bool closes() {
    while (receive(20s)) continue;
    return ended_;
  }

 private:
  bool receive(std::chrono::milliseconds timeout) {
    pollfd entry{fd(), POLLIN, 0};
    if (::poll(&entry, 1, static_cast<int>(timeout.count())) <= 0) return false;
    char bytes[65536];
    const ssize_t n = ::recv(fd(), bytes, sizeof bytes, 0);
    ended_ = n <= 0;
    if (n > 0) got_.append(bytes, static_cast<std::size_t>(n));
    return n > 0;
  }

  Descriptor fd_;
  std::string got_;
  bool ended_ = false;
};

inline std::string get(const std::string& target, const std::string& fields = "") {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost:1\r\n" + fields + "\r\n";
}

inline std::string post(const std::string& body, const std::string& fields = "") {
  return "POST /rpc HTTP/1.1\r\nHost: localhost:1\r\nContent-Type: application/json\r\n" + fields +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

inline std::string call(const std::string& method, const std::string& params = "{}") {
  return R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + params + R"(,"id":1})";
}

class WebPage : public ::testing::Test {
 protected:
  explicit WebPage(const ServerOptions& options = {}) : server_(options) {
    server_.table.add({.name = "write",
                       .summary = "Changes something.",
                       .result = "true",
                       .writes = true,
                       .handler = [](const Params&) -> Result<std::string> { return "true"; }});
    server_.table.add({.name = "later",
                       .summary = "Answers from another thread.",
                       .result = "true",
                       .handler = [](const Params&, Reply reply) {
                         std::thread([r = std::make_shared<Reply>(std::move(reply))] {
                           (*r)(std::string("true"));
                         }).detach();
                       }});
    server_.table.add({.name = "subscribe",
                       .summary = "Needs a connection that stays.",
                       .result = "true",
                       .subscribes = true,
                       .handler = [](const Params&) -> Result<std::string> { return "true"; }});
    server_.service->add_topic({.name = "value"});
    server_.service->add_topic({.name = "event", .event = true, .min_interval = 0ms});
    server_.page = std::make_unique<HttpServer>(
        server_.loop, *server_.service,
        HttpSetup{.token = kTestToken, .hosts = {"Mill.local:8080"}, .files = kTestPage});
    const auto port = server_.page->listen("127.0.0.1", 0);
    EXPECT_TRUE(port.has_value());
    port_ = port.value_or(0);
    server_.start();
  }

  HttpClient client() const { return HttpClient(port_); }
  Answer ask(const std::string& request) const { return client().ask(request); }
  int status_of(const std::string& request) const { return ask(request).status; }
  void publish(const std::string& topic, const std::string& json) {
    server_.on_loop([&] { return server_.service->publish(topic, json).has_value(); });
  }
  std::size_t open() {
    return server_.on_loop([this] { return server_.page->connection_count(); });
  }
  bool open_become(std::size_t n) {
    for (const auto end = Clock::now() + 20s; Clock::now() < end; std::this_thread::sleep_for(2ms))
      if (open() == n) return true;
    return false;
  }

  TestServer server_;
  std::uint16_t port_ = 0;
};

}  // namespace mdof::rpc::test
