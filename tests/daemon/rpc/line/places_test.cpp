// Limits of the number of connections. No user can use all connections, and one connection is
// reserved for the machine's control.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

const std::string kAsk = R"({"jsonrpc":"2.0","method":"get_data","id":1})";
const std::string kAnswer = R"({"jsonrpc":"2.0","result":["hello",5],"id":1})";
constexpr uid_t kNobody = 65534;

std::vector<std::unique_ptr<RawClient>> connect_clients(const TestServer& server, int count) {
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < count; ++i) {
    clients.push_back(std::make_unique<RawClient>(server.path));
    EXPECT_EQ(clients.back()->ask(kAsk), kAnswer);
  }
  return clients;
}

// The message with which the server rejects a new client; empty if the server accepts the client.
std::string refusal(const TestServer& server) {
  RawClient client(server.path);
  const std::string line = client.ask(kAsk);
  return line == kAnswer ? "" : at(line, "/error/message");
}

ServerOptions limits(std::size_t of_user) {
  ServerOptions options;
  options.max_connections = 6;
  options.max_connections_of_user = of_user;
  return options;
}

TEST(Places, OneUserCannotUseAllConnections) {
  TestServer server(limits(3));
  server.start();
  auto clients = connect_clients(server, 3);
  const std::string why = refusal(server);
  EXPECT_NE(why.find("uid " + std::to_string(::getuid()) + " has 3 connections"), std::string::npos)
      << why;
  EXPECT_NE(why.find("connections_of_user"), std::string::npos) << why;
  clients.pop_back();
  ASSERT_TRUE(server.connections_become(2));
  EXPECT_EQ(refusal(server), "");
}

RawClient tcp_client(std::uint16_t port) {
  Descriptor fd(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return RawClient(std::move(fd));
}

TEST(Places, TwoTransportsShareTheLimitOfAUser) {
  TestServer server(limits(3));
  const auto port = server.server->listen_tcp("127.0.0.1", 0);
  ASSERT_TRUE(port.has_value());
  server.start();
  const auto clients = connect_clients(server, 2);
  RawClient third = tcp_client(*port);
  EXPECT_EQ(third.ask(kAsk), kAnswer);
  EXPECT_NE(refusal(server).find(" has 3 connections"), std::string::npos);
  const std::string why = tcp_client(*port).line();
  EXPECT_NE(why.find("uid " + std::to_string(::getuid()) + " has 3 connections"), std::string::npos)
      << why;
}

// Connects from a child process of another user. The exit code states whether the server accepted
// the client.
int unprivileged_exit_code(const TestServer& server) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) ::_exit(2);
    ::_exit(refusal(server).empty() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST(Places, OtherUsersAreAcceptedWhenOneUserIsAtHisLimit) {
  if (::getuid() != 0) GTEST_SKIP() << "only root can become another user";
  TestServer server(limits(3));
  ::chmod(server.path.c_str(), 0666);
  server.start();
  const auto clients = connect_clients(server, 3);
  EXPECT_EQ(unprivileged_exit_code(server), 0);
}

TEST(Places, OneConnectionIsReservedForTheControlGroup) {
  ServerOptions options = limits(64);
  options.kept_for_group = ::getgid();
  TestServer server(options);
  server.start();
  const auto all = connect_clients(server, 6);
  EXPECT_NE(refusal(server).find("all 6 connections are in use"), std::string::npos);
}

TEST(Places, AUserAtHisLimitGetsTheReservedConnection) {
  ServerOptions options = limits(2);
  options.kept_for_group = ::getgid();
  TestServer server(options);
  server.start();
  const auto mine = connect_clients(server, 3);
  EXPECT_NE(refusal(server).find("has 2 connections"), std::string::npos);
}

TEST(Places, OthersDoNotGetTheReservedConnection) {
  ServerOptions options = limits(64);
  options.kept_for_group = 4'000'000;  // this group does not exist
  TestServer server(options);
  server.start();
  const auto others = connect_clients(server, 5);
  EXPECT_NE(refusal(server).find("reserved for the group in cnc_group"), std::string::npos);
}

TEST(Places, ASlowAnswerIsNotIdleTime) {
  ServerOptions options;
  options.idle_timeout = 200ms;
  TestServer server(options);
  std::thread later;
  server.table.add({.name = "slow",
                    .summary = "Answers late.",
                    .result = "1",
                    .handler = [&](const Params&, Reply reply) {
                      auto shared = std::make_shared<Reply>(std::move(reply));
                      later = std::thread([shared] {
                        std::this_thread::sleep_for(600ms);
                        (*shared)("1");
                      });
                    }});
  server.start();
  RawClient client(server.path);
  EXPECT_EQ(at(client.ask(R"({"jsonrpc":"2.0","method":"slow","id":1})"), "/result"), "1");
  // Sent immediately after the late answer: the connection is still open.
  EXPECT_EQ(client.ask(kAsk), kAnswer);
  later.join();
}

}  // namespace
}  // namespace mdof::rpc::test
