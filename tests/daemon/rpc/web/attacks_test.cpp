// Malicious or broken browsers. Each is rejected or disconnected, and uses a bounded amount of
// memory. The machine's control on the Unix socket continues to work.
#include <deque>
#include <fstream>

#include "tests/daemon/rpc/web/http_fixture.h"

namespace mdof::rpc::test {
namespace {

// Largest increase of memory that a hostile browser may cause. The limit is higher with ASan,
// which keeps up to 256 MB of freed memory.
#ifdef MDOF_SANITIZED
constexpr double kMost_mb = 400;
#else
constexpr double kMost_mb = 20;
#endif

double resident_memory_mb() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * double(::sysconf(_SC_PAGESIZE)) / 1e6;
}

class HostileBrowser : public WebPage {
 protected:
  static ServerOptions short_times() {
    ServerOptions o;
    o.request_timeout = 300ms;
    o.stall_timeout = 500ms;
    o.drain_timeout = 300ms;
    o.http_idle_timeout = 2000ms;
    o.max_http_connections = 40;
    o.max_http_streams = 8;
    o.max_connections = 4;
    return o;
  }
  explicit HostileBrowser(const ServerOptions& options = short_times()) : WebPage(options) {}
  // Checks that the machine's control and another browser are served normally.
  void expect_others_served() {
    RawClient control(server_.path);
    EXPECT_EQ(at(control.ask(call("get_data")), "/result/1"), "5");
    HttpClient browser = client();
    EXPECT_EQ(browser.ask(post(call("get_data"))).status, 200);
  }
};

// The body of the first request contains text that looks like a second request. The server must
// not process this text as a request.
TEST_F(HostileBrowser, CannotSmuggleARequest) {
  const std::string hidden = post(call("write"), "Authorization: Bearer " + kTestToken + "\r\n");
  const std::string start =
      "POST /rpc HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n";
  for (const std::string& fields :
       {std::string("Content-Length: 0\r\nContent-Length: 44\r\n"),
        std::string("Content-Length: 4\r\nTransfer-Encoding: chunked\r\n"),
        std::string("Transfer-Encoding: chunked\r\nContent-Length: 4\r\n"),
        std::string("Transfer-Encoding: chunked\r\n"),
        std::string("Transfer-Encoding:\tchunked\r\n"),
        std::string("Transfer-Encoding: x\r\n chunked\r\n"),
        std::string("X: y\nContent-Length: 0\r\n"), std::string("Content-Length : 0\r\n"),
        std::string("Content-Length: 0\r\n 4\r\n")}) {
    HttpClient client = this->client();
    client.send(start + fields + "\r\n0\r\n\r\n" + hidden);
    const Answer answer = client.answer();
    EXPECT_GE(answer.status, 400) << fields;
    EXPECT_EQ(answer.field("Connection"), "close") << fields;
    EXPECT_EQ(client.until("HTTP/1.1"), "") << fields;  // there is no second answer
    EXPECT_TRUE(client.closes());
  }
  expect_others_served();
}

TEST_F(HostileBrowser, TooLargeRequestsAreRejected) {
  EXPECT_EQ(status_of(get("/", "X: " + std::string(10'000, 'x') + "\r\n")), 431);
  EXPECT_EQ(status_of(get("/" + std::string(100'000, 'x'))), 431);
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += "A: b\r\n";
  EXPECT_EQ(status_of(get("/", many)), 431);
  EXPECT_EQ(status_of("POST /rpc HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                      "Content-Length: 1073741824\r\n\r\n"),
            413);
  const std::string deep = std::string(40, '[') + std::string(40, ']');
  EXPECT_EQ(at(ask(post(deep)).body, "/error/code"), "-32700");
  HttpClient endless = client();
  const std::string block(65536, 'x');
  endless.send("GET /");
  while (endless.send(block)) continue;  // until the server closes the connection
  expect_others_served();
}

// Clients that send a head or a body one byte at a time, and a client that sends nothing.
TEST_F(HostileBrowser, SlowClientsAreClosed) {
  std::vector<HttpClient> slow;
  for (int i = 0; i < 30; ++i) slow.push_back(client());
  const std::string request = post(std::string(1000, ' '));
  for (std::size_t i = 0; i < slow.size(); ++i)
    slow[i].send(i % 2 == 0 ? request.substr(0, 15) : request.substr(0, request.size() - 900));
  for (int k = 0; k < 20; ++k) {
    for (HttpClient& each : slow) each.send(" ");
    std::this_thread::sleep_for(20ms);
  }
  for (HttpClient& each : slow) EXPECT_EQ(each.answer().status, 408);
  expect_others_served();
  HttpClient silent = client();
  EXPECT_TRUE(silent.closes());  // closed after http_idle_timeout, without an answer
}

// The browser opens ten thousand connections and closes none.
TEST_F(HostileBrowser, OpensTenThousandConnections) {
  std::deque<HttpClient> open;
  const double before = resident_memory_mb();
  std::size_t most = 0;
  for (int i = 0; i < 10'000; ++i) {
    open.push_back(client());
    if (open.size() > 200) open.pop_front();
    if (i % 50 == 0) most = std::max(most, this->open());
  }
  EXPECT_LE(most, 40U);
  EXPECT_LT(resident_memory_mb() - before, kMost_mb);
  expect_others_served();
  open.clear();
  EXPECT_TRUE(open_become(0));
}

// If all connections are used, active clients remain connected. A further client gets the answer
// 503.
TEST_F(HostileBrowser, CannotExceedTheConnectionLimit) {
  std::vector<HttpClient> streams;
  for (int i = 0; i < 8; ++i) {
    streams.push_back(client());
    streams.back().send(get("/events?topics=value,event"));
    ASSERT_NE(streams.back().until("\n\n"), "");
  }
  EXPECT_EQ(status_of(get("/events?topics=value")), 503);
  std::vector<HttpClient> busy;
  while (open() < 40) {
    busy.push_back(client());
    busy.back().send("GET");
  }
  const Answer late = ask(get("/"));
  EXPECT_TRUE(late.status == 503 || late.status == 200)
      << late.status;               // 200 if the server has closed a slow client
  RawClient control(server_.path);  // the Unix socket has its own connections
  EXPECT_EQ(at(control.ask(call("get_data")), "/result/1"), "5");
  publish("event", "1");
  for (HttpClient& each : streams) EXPECT_NE(each.until("\"value\":1}"), "");
}

// A browser never reads its stream. The other clients get each event. The waiting events are not
// copied for this browser. The server closes the stream after stall_timeout.
TEST_F(HostileBrowser, AStreamThatIsNeverReadIsDropped) {
  HttpClient deaf = client(), good = client();
  const int bytes = 4096;
  ::setsockopt(deaf.fd(), SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
  for (HttpClient* each : {&deaf, &good})
    each->send(get("/events?topics=value,event&interval_ms=20"));
  ASSERT_NE(good.until("\n\n"), "");
  ASSERT_NE(good.until("\n\n"), "");
  const double before = resident_memory_mb();
  const std::string large(20'000, 'x');
  int sent = 0;
  for (const auto end = Clock::now() + 20s; open() == 2 && Clock::now() < end; ++sent) {
    publish("event", "[" + std::to_string(sent) + ",\"" + large + "\"]");
    publish("value", std::to_string(sent));
    ASSERT_NE(good.until("[" + std::to_string(sent) + ","), "") << sent;
  }
  EXPECT_EQ(open(), 1U) << sent;
  EXPECT_GT(sent, 10);
  EXPECT_LT(resident_memory_mb() - before, kMost_mb);
  EXPECT_NE(server_.log().find("browser dropped: the browser has accepted no data for"),
            std::string::npos);
  expect_others_served();
}

// The browser closes the connection after each byte of a request, and while it receives a late
// reply.
TEST_F(HostileBrowser, MayDisconnectAtAnyByte) {
  const std::string request = post(call("later"));
  for (std::size_t n = 1; n <= request.size(); ++n) client().send(request.substr(0, n));
  for (int i = 0; i < 20; ++i) {
    HttpClient stream = client();
    stream.send(get("/events?topics=value,event"));
    publish("event", "1");
  }
  publish("event", "2");
  EXPECT_TRUE(open_become(0));
  expect_others_served();
}

}  // namespace
}  // namespace mdof::rpc::test
