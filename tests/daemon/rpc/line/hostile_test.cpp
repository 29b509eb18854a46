// Malicious or broken clients. Each gets the correct error code or is disconnected. Other clients
// are not affected.
#include <fcntl.h>

#include <atomic>
#include <cerrno>
#include <ctime>
#include <fstream>

#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

const std::string kGood = R"({"jsonrpc":"2.0","method":"get_data","id":1})";
const std::string kGoodReply = R"({"jsonrpc":"2.0","result":["hello",5],"id":1})";

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * double(::sysconf(_SC_PAGESIZE)) / 1e6;
}

// Another client, which works normally during a test.
class Bystander {
 public:
  explicit Bystander(const std::string& path) : thread_([this, path] { work(path); }) {}
  ~Bystander() {
    stop_ = true;
    thread_.join();
    EXPECT_GT(trips_, 0);
    EXPECT_EQ(wrong_, 0);
    // The limit is large, because sanitizers and other processes slow the machine down.
    EXPECT_LT(longest_ms_, 1000);
    std::printf("  another client: %d round trips, mean %.3f ms, longest %.1f ms\n", trips_,
                total_ms_ / trips_, longest_ms_);
  }

 private:
  void work(const std::string& path) {
    RawClient client(path);
    while (!stop_ || trips_ == 0) {
      const auto begin = Clock::now();
      wrong_ += client.ask(kGood) != kGoodReply;
      const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
      longest_ms_ = std::max(longest_ms_, ms);
      total_ms_ += ms;
      ++trips_;
      std::this_thread::sleep_for(1ms);
    }
  }
  int trips_ = 0, wrong_ = 0;
  double longest_ms_ = 0, total_ms_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

class Hostile : public ::testing::Test {
 protected:
  static ServerOptions options() {
    ServerOptions o;
    o.request_timeout = 400ms;
    o.stall_timeout = 600ms;
    o.drain_timeout = 400ms;
    o.max_connections_of_user = 64;
    return o;
  }
  Hostile() { server_.start(); }
  // After this error the connection must remain open.
  void expect_error(const std::string& line, const std::string& code, const std::string& data) {
    const Bystander bystander(server_.path);
    RawClient client(server_.path);
    const auto reply = client.ask(line);
    EXPECT_EQ(at(reply, "/error/code"), code) << reply;
    EXPECT_EQ(at(reply, "/id"), "null");
    EXPECT_EQ(at(reply, "/error/data"), data);
    EXPECT_EQ(client.ask(kGood), kGoodReply);
  }
  TestServer server_{options()};
};

TEST_F(Hostile, BrokenUtf8IsAParseError) {
  for (const std::string bytes : {"\xff", "\xc3", "\xed\xa0\x80", "\xc0\x80", "\xf5\x80\x80\x80"})
    expect_error(R"({"jsonrpc":"2.0","method":"get_data","id":")" + bytes + "\"}", "-32700",
                 R"("the line is not UTF-8")");
}

TEST_F(Hostile, NulBytesAreAParseError) {
  expect_error(std::string("\0\0\0", 3), "-32700", "");
  expect_error(R"({"jsonrpc":"2.0","method":"get_)" + std::string(1, '\0') + R"(data","id":1})",
               "-32700", "");
  expect_error(kGood + std::string(1, '\0'), "-32700", "");
}

TEST_F(Hostile, NestingHasALimit) {
  const auto nested = [](std::size_t n) {
    std::string value;
    for (std::size_t i = 0; i < n; ++i) value += R"({"a":)";
    return value + "1" + std::string(n, '}');
  };
  expect_error(nested(5000), "-32700", R"("the JSON is nested deeper than 32 levels")");
  expect_error(std::string(30000, '[') + std::string(30000, ']'), "-32700",
               R"("the JSON is nested deeper than 32 levels")");
  RawClient client(server_.path);
  const std::string deep = nested(27);
  EXPECT_EQ(at(client.ask(R"({"jsonrpc":"2.0","method":"echo","params":{"value":)" + deep +
                          R"(},"id":1})"),
               "/result"),
            deep);
}

TEST_F(Hostile, NumbersBeyondTheirTypeAreAParseError) {
  expect_error(R"({"jsonrpc":"2.0","method":"sum","params":[1e999],"id":1})", "-32700",
               R"("a number is malformed or too large")");
}

TEST_F(Hostile, ABatchOfTenThousandIsRejectedAsOne) {
  std::string batch = "[1";
  for (int i = 1; i < 10000; ++i) batch += ",1";
  expect_error(batch + "]", "-32600",
               R"("a batch may have at most 100 members; divide the batch")");
}

TEST_F(Hostile, ALineOfAMegabyteIsAnsweredOnceAndClosed) {
  const Bystander bystander(server_.path);
  const double before = resident_mb();
  for (const std::string& line :
       {std::string(1 << 20, 'x'), std::string(100000, '[') + std::string(100000, ']'),
        "[" + std::string(10000 * 100, ' ') + "]"}) {
    RawClient client(server_.path);
    client.send(line + "\n" + kGood + "\n");
    const auto reply = client.line();
    EXPECT_EQ(at(reply, "/error/code"), "-32600");
    EXPECT_EQ(at(reply, "/id"), "null");
    EXPECT_EQ(client.line(), "<closed>");
  }
  EXPECT_LT(resident_mb() - before, 128);
  EXPECT_TRUE(server_.connections_become(1));
}

TEST_F(Hostile, TheLineLimitIsExact) {
  const std::string head = R"({"jsonrpc":"2.0","method":"get_data","id":1,"x":")";
  const auto line = [&](std::size_t size) {
    return head + std::string(size - head.size() - 2, 'x') + "\"}";
  };
  EXPECT_EQ(RawClient(server_.path).ask(line(65536)), kGoodReply);
  EXPECT_EQ(RawClient(server_.path).ask(line(65536) + "\r"), kGoodReply);
  EXPECT_EQ(at(RawClient(server_.path).ask(line(65537)), "/error/code"), "-32600");
}

// The client requests replies of 300 MB in total. If the server stored all of them, the memory
// would be full.
TEST_F(Hostile, AClientThatNeverReadsIsPausedAndThenDropped) {
  const Bystander bystander(server_.path);
  const double before = resident_mb();
  RawClient client(server_.path);
  ::fcntl(client.fd(), F_SETFL, O_NONBLOCK);
  const std::string request = R"({"jsonrpc":"2.0","method":"bytes","params":[40000],"id":1})"
                              "\n";
  int sent = 0;
  for (const auto end = Clock::now() + 20s; Clock::now() < end;) {
    if (client.send(request))
      ++sent;
    else if (errno == EPIPE || errno == ECONNRESET)
      break;
    else
      std::this_thread::sleep_for(1ms);
  }
  EXPECT_GT(sent, 100);
  EXPECT_TRUE(server_.connections_become(1));
  EXPECT_LT(resident_mb() - before, 128);
  EXPECT_NE(server_.log().find("dropped: the client has accepted no data for"), std::string::npos)
      << server_.log();
}

TEST_F(Hostile, AClientThatReadsSlowlyIsNotDropped) {
  RawClient client(server_.path);
  std::string requests;
  for (int i = 0; i < 60; ++i)
    requests += R"({"jsonrpc":"2.0","method":"bytes","params":[40000],"id":1})"
                "\n";
  client.send(requests);
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(client.line().size(), 40036u);
    std::this_thread::sleep_for(25ms);  // 1.5 s in total, which is over twice the stall limit
  }
}

TEST_F(Hostile, AClientThatSendsTooSlowlyIsClosed) {
  const Bystander bystander(server_.path);
  RawClient client(server_.path);
  const auto begin = Clock::now();
  bool open = true;
  for (std::size_t i = 0; open && i < 10 * kGood.size();
       ++i) {  // the time between two bytes is allowed, the time of the whole request is not
    open = client.send(kGood.substr(i % 10, 1));
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_FALSE(open);
  EXPECT_LT(Clock::now() - begin, 5s);
  EXPECT_EQ(at(client.line(), "/error/data"),
            R"("the request line was not complete within 400 ms")");
  EXPECT_EQ(client.line(), "<closed>");
  EXPECT_TRUE(server_.connections_become(1));
}

TEST_F(Hostile, IdleClientsRemainConnected) {
  RawClient client(server_.path);
  std::this_thread::sleep_for(1s);  // longer than all time limits of the server
  EXPECT_EQ(client.ask(kGood), kGoodReply);
}

// If an event remained in the queue of the loop, the loop would run continuously.
TEST(HostileIdle, IdleClientsUseNoCpu) {
  TestServer server;
  server.start();
  RawClient idle(server.path), half(server.path), stalled(server.path), partial(server.path);
  idle.ask(kGood);
  half.send("{");
  ::shutdown(half.fd(), SHUT_WR);
  partial.send("{");
  std::string requests;
  for (int i = 0; i < 200; ++i)
    requests += R"({"jsonrpc":"2.0","method":"bytes","params":[40000],"id":1})"
                "\n";
  stalled.send(requests);
  std::this_thread::sleep_for(200ms);
  const std::clock_t begin = std::clock();
  std::this_thread::sleep_for(500ms);
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 0.05);
}

TEST(HostileIdle, TheIdleLimitClosesConnectionsIfSet) {
  ServerOptions options;
  options.idle_timeout = 100ms;
  TestServer server(options);
  server.start();
  RawClient client(server.path);
  EXPECT_EQ(client.ask(kGood), kGoodReply);
  const auto why = client.line();
  EXPECT_EQ(at(why, "/error/code"), "-32000");
  EXPECT_NE(why.find("(no request, no subscription); connect again"), std::string::npos) << why;
  EXPECT_EQ(client.line(), "<closed>");
  EXPECT_TRUE(server.connections_become(0));
}

TEST_F(Hostile, RejectsOneConnectionTooManyWithAReason) {
  const Bystander bystander(server_.path);
  ASSERT_TRUE(server_.connections_become(1));
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 63; ++i) clients.push_back(std::make_unique<RawClient>(server_.path));
  for (auto& client : clients) EXPECT_EQ(client->ask(kGood), kGoodReply);
  for (int i = 0; i < 20; ++i) {
    RawClient extra(server_.path);
    EXPECT_EQ(at(extra.line(), "/error/code"), "-32000");
    EXPECT_EQ(extra.line(), "<closed>");
  }
  clients.pop_back();
  ASSERT_TRUE(server_.connections_become(63));
  EXPECT_EQ(RawClient(server_.path).ask(kGood), kGoodReply);
}

TEST_F(Hostile, AFloodOfRequestsDoesNotBlockTheOthers) {
  const Bystander bystander(server_.path);
  std::string flood;
  for (int i = 0; i < 1000; ++i) flood += kGood + "\n";
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      RawClient client(server_.path);
      std::thread reader([&] {
        for (int i = 0; i < 20000; ++i) ASSERT_EQ(client.line(), kGoodReply);
      });
      for (int i = 0; i < 20; ++i) client.send(flood);
      reader.join();
    });
  for (auto& thread : threads) thread.join();
}

TEST_F(Hostile, ClientsThatDisconnectAnywhereLeaveNothing) {
  const Bystander bystander(server_.path);
  for (int i = 0; i < 200; ++i) {
    RawClient client(server_.path);
    client.send((kGood + "\n" + kGood + "\n" + kGood).substr(0, 20 + std::size_t(i) % 90));
  }
  EXPECT_TRUE(server_.connections_become(1));
}

TEST_F(Hostile, GarbageOfEveryKindIsAnsweredOrClosed) {
  const Bystander bystander(server_.path);
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525u + 1013904223u; };
  const std::string seeds[] = {
      kGood, R"([{"jsonrpc":"2.0","method":"sum","params":{"a":1},"id":"x"}])",
      R"({"jsonrpc":"2.0","method":"subtract","params":[1,2],"id":-1.5e3})"};
  RawClient client(server_.path);
  for (int i = 0; i < 3000; ++i) {
    std::string line = seeds[next() % 3];
    for (unsigned k = 1 + (next() >> 8) % 4; k > 0; --k)
      line[(next() >> 8) % line.size()] = static_cast<char>(next() >> 24);
    std::replace(line.begin(), line.end(), '\n', ' ');
    const std::string marker = "\"marker " + std::to_string(i) + "\"";
    client.send(line + "\n" + R"({"jsonrpc":"2.0","method":"sum","id":)" + marker + "}\n");
    std::string reply = client.line();
    ASSERT_EQ(canonical(reply).find("not JSON"), std::string::npos) << line << "\n" << reply;
    if (at(reply, "/id") != marker)
      reply = client.line();  // the first reply was to the damaged line
    ASSERT_EQ(at(reply, "/id"), marker) << line;
  }
}

}  // namespace
}  // namespace mdof::rpc::test
