// One thread processes all requests. If other clients wait, a client uses this thread for one turn
// at most.
#include <arpa/inet.h>
#include <netinet/in.h>

#include <atomic>

#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

const std::string kCount = R"({"jsonrpc":"2.0","method":"count","id":1})";
const std::string kSpin = R"({"jsonrpc":"2.0","method":"spin","id":2})";
const std::string kSpinNotification = R"({"jsonrpc":"2.0","method":"spin"})";
constexpr int kMany = 60;

// The method `spin` takes 3 ms. The method `count` returns the number of calls of `spin`.
class Turns : public ::testing::Test {
 protected:
  Turns() : server_(short_drain_options()) {
    server_.table.add({.name = "spin",
                       .summary = "Takes long.",
                       .result = "1",
                       .handler = [this](const Params&) -> Result<std::string> {
                         for (const auto end = Clock::now() + 3ms; Clock::now() < end;) {
                         }
                         ++spins_;
                         return "1";
                       }});
    server_.table.add({.name = "count",
                       .summary = "Counts.",
                       .result = "how many",
                       .handler = [this](const Params&) -> Result<std::string> {
                         return std::to_string(spins_);
                       }});
  }
  static ServerOptions short_drain_options() {
    ServerOptions options;
    options.drain_timeout = 40ms;  // the server checks the clients eight times in this time
    return options;
  }
  // First, one client sends the batch `many`. Then another client sends a request. Returns the
  // number of calls of the batch that the server ran before it answered the other client.
  int calls_before_other_reply(const std::string& many) {
    RawClient greedy(server_.path), other(server_.path);
    other.ask(kCount);
    greedy.send(many);
    while (spins_ == 0) std::this_thread::yield();
    return std::stoi(at(other.ask(kCount), "/result"));
  }

  std::atomic<int> spins_ = 0;
  TestServer server_;
};

TEST_F(Turns, OthersAreServedBetweenConsecutiveRequests) {
  server_.start();
  std::string many;
  for (int i = 0; i < kMany; ++i) many += kSpin + "\n";
  EXPECT_LT(calls_before_other_reply(many), kMany / 2);
}

TEST_F(Turns, OthersAreServedBetweenMembersOfABatch) {
  server_.start();
  std::string many = "[" + kSpin;
  for (int i = 1; i < kMany; ++i) many += "," + kSpin;
  EXPECT_LT(calls_before_other_reply(many + "]\n"), kMany / 2);
}

TEST_F(Turns, ADividedBatchIsAnsweredBeforeTheNextRequest) {
  server_.start();
  RawClient client(server_.path);
  std::string batch = "[" + kSpin;
  for (int i = 1; i < 5; ++i) batch += "," + kSpin;
  client.send(batch + "]\n" + kCount + "\n");
  const std::string reply = client.line();
  std::string expected = "[";
  for (int i = 0; i < 5; ++i)
    expected += std::string(i > 0 ? "," : "") + R"({"jsonrpc":"2.0","result":1,"id":2})";
  EXPECT_EQ(reply, expected + "]");
  EXPECT_EQ(at(client.line(), "/result"), "5");
}

// The requests are notifications, so the server sends no replies. A failed reply would reveal that
// the client has closed the connection.
TEST_F(Turns, DropsTheRequestsOfAClosedConnection) {
  server_.start();
  {
    RawClient client(server_.path);
    std::string many;
    for (int i = 0; i < 10 * kMany; ++i) many += kSpinNotification + "\n";
    client.send(many);
    while (spins_ == 0) std::this_thread::yield();
  }
  ASSERT_TRUE(server_.connections_become(0));
  EXPECT_LT(spins_, 5 * kMany);
}

TEST_F(Turns, RunsRequestsSentJustBeforeTheConnectionClosed) {
  server_.start();
  for (int i = 1; i <= 20; ++i) {
    RawClient(server_.path).send(kSpinNotification + "\n");
    for (const auto end = Clock::now() + 20s; spins_ < i && Clock::now() < end;)
      std::this_thread::yield();
    ASSERT_EQ(spins_, i);
  }
}

class Http : public Turns {
 protected:
  RawClient tcp_client() {
    const auto port = server_.server->listen_tcp("127.0.0.1", 0);
    server_.start();
    Descriptor fd(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port.value());
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return RawClient(std::move(fd));
  }
  void expect_closed_unrun(const std::string& head) {
    RawClient client = tcp_client();
    client.send(head + "\r\n\r\n" + kSpin + "\n" + kSpin + "\n");
    const std::string why = client.line();
    EXPECT_EQ(at(why, "/error/code"), "-32600") << why;
    EXPECT_NE(why.find("HTTP"), std::string::npos) << why;
    EXPECT_EQ(client.line(), "<closed>");
    EXPECT_EQ(spins_, 0);
  }
};

TEST_F(Http, AnHttpPostCallsNoMethod) {
  expect_closed_unrun("POST / HTTP/1.1\r\nHost: 127.0.0.1:7341\r\nContent-Type: text/plain");
}
TEST_F(Http, AnotherHttpMethodCallsNoMethod) {
  expect_closed_unrun("patch http://127.0.0.1:7341/x HTTP/1.1");
}
TEST_F(Http, AnOldHttpGetCallsNoMethod) {
  expect_closed_unrun("GET /");
}
TEST_F(Http, AnHttpHeaderLineCallsNoMethod) {
  expect_closed_unrun("X-Requested-With: mdof");
}

TEST_F(Http, OtherTextIsAParseErrorAndKeepsTheConnection) {
  RawClient client = tcp_client();
  for (const char* text :
       {"hello", "hello world", "1", "true ", "get", ": x", "\"POST / HTTP/1.1"}) {
    const std::string reply = client.ask(text);
    EXPECT_NE(at(reply, "/error/code"), "") << text;
    EXPECT_EQ(reply.find("HTTP"), std::string::npos) << text;
  }
  EXPECT_EQ(at(client.ask(kCount), "/result"), "0");
}

TEST_F(Http, AnHttpLineOnAUnixSocketIsAParseError) {
  server_.start();
  RawClient client(server_.path);
  EXPECT_EQ(at(client.ask("POST / HTTP/1.1"), "/error/code"), "-32700");
  EXPECT_EQ(at(client.ask(kCount), "/result"), "0");
}

}  // namespace
}  // namespace mdof::rpc::test
