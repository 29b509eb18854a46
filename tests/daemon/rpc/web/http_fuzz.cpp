// Bytes from a browser. The fuzzer reads them as a head, whole and in two parts. Then it sends
// them through a connection. For any input:
// - an accepted head obeys the rules
// - an answer is HTTP
// - a request without the token changes nothing
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/rpc/web/events/event_query.h"
#include "daemon/rpc/web/http_head.h"
#include "daemon/rpc/web/http_server_core.h"
#include "daemon/rpc/web/same_site.h"

namespace {

using namespace mdof;
using namespace mdof::rpc;

constexpr std::array<PageFile, 1> kFuzzPage{{{"index.html", "<!doctype html>"}}};

void require(bool holds) {
  if (!holds) std::abort();
}

void read_as_head(std::string_view text, std::size_t first_part) {
  constexpr HttpLimits kLimits{8192, 65536};
  std::size_t whole = 0, parts = 0;
  const auto end = head_length(text, whole, kLimits.head_bytes);
  const auto before = head_length(text.substr(0, first_part), parts, kLimits.head_bytes);
  if (before && *before == 0) {
    const auto after = head_length(text, parts, kLimits.head_bytes);
    require(after.has_value() == end.has_value() && (!end || *after == *end));
  }
  if (!end || *end == 0) return;
  require(*end <= kLimits.head_bytes && text.substr(0, *end).ends_with("\r\n\r\n"));
  const auto head = read_head(text.substr(0, *end), kLimits);
  if (!head) return require(head.error().status >= 400 && !head.error().text.empty());
  require(head->path.starts_with('/') && head->body_bytes <= kLimits.body_bytes);
  for (const std::string* field : {&head->method, &head->path, &head->query, &head->host,
                                   &head->origin, &head->authorization, &head->last_event_id})
    require(field->find_first_of(std::string("\r\n\0", 3)) == std::string::npos);
  (void)check_same_site(*head, {"mill.local:8080"});
  if (const auto query = read_event_query(head->query)) require(!query->topics.empty());
}

const MethodTable& fuzzed_methods() {
  static const MethodTable& made = *[] {
    auto* table = new MethodTable("fuzz", "1");
    table->add({.name = "read",
                .summary = "Gives a number.",
                .result = "1",
                .handler = SyncHandler([](const Params&) -> Result<std::string> { return "1"; })});
    table->add(
        {.name = "write",
         .summary = "May not be called.",
         .result = "nothing",
         .writes = true,
         .handler = SyncHandler([](const Params&) -> Result<std::string> { std::abort(); })});
    return table;
  }();
  return made;
}

struct FuzzedPage {
  EventLoop loop;
  Service service{loop.executor(), fuzzed_methods(), [] {
                    ServerOptions options;
                    options.log = [](const std::string&) {};
                    return options;
                  }()};
  std::shared_ptr<HttpServerCore> core;

  FuzzedPage() {
    service.add_topic({.name = "live.update"});
    service.add_topic(
        {.name = "run.event", .event = true, .min_interval = std::chrono::milliseconds(0)});
    core = std::make_shared<HttpServerCore>(loop.core(), service,
                                            HttpSetup{.token = "", .files = kFuzzPage});
  }
};

void serve(std::string_view text) {
  static FuzzedPage& served = *new FuzzedPage;
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) != 0) return;
  (void)::send(ends[0], text.data(), text.size(), MSG_NOSIGNAL);
  ::shutdown(ends[0], SHUT_WR);
  served.core->adopt(ends[1]);
  auto& context = *served.loop.core()->context;
  for (int i = 0; i < 200 && !served.core->connections.empty(); ++i) {
    context.restart();
    context.poll();
    (void)served.service.publish("run.event", "1");
  }
  if (!served.core->connections.empty()) served.core->connections.front()->close();
  char bytes[4096];
  const ssize_t got = ::recv(ends[0], bytes, sizeof bytes, 0);
  if (got > 0) require(std::string_view(bytes, std::size_t(got)).starts_with("HTTP/1.1 "));
  ::close(ends[0]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_as_head(text, size == 0 ? 0 : data[0] * 16U % size);
  serve(text);
  return 0;
}
