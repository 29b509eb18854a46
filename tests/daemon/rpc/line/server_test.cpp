#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <fstream>

#include "daemon/rpc/line/client.h"
#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

const std::string kGood = R"({"jsonrpc":"2.0","method":"get_data","id":1})";

RawClient tcp_client(std::uint16_t port) {
  Descriptor fd(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return RawClient(std::move(fd));
}

std::string error_of(const Status& status) {
  return status.has_value() ? "no error" : status.error().message;
}

TEST(Server, TheSocketIsForOwnerAndGroup) {
  const TestServer server;
  struct stat info {};
  ASSERT_EQ(::stat(server.path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777u, 0660u);
}

TEST(Server, RemovesItsSocketAtTheEnd) {
  std::string path;
  {
    const TestServer server;
    path = server.path;
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Server, RejectsASocketThatAnotherDaemonServes) {
  TestServer first;
  first.start();
  EventLoop loop;
  Service service(loop.executor(), first.table);
  LineServer second(loop, service);
  const auto status = second.listen_unix(first.path);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::conflict);
  EXPECT_NE(error_of(status).find("another program (perhaps mdofd) answers"), std::string::npos);
  EXPECT_EQ(RawClient(first.path).ask(kGood).substr(0, 15), R"({"jsonrpc":"2.0)");
}

TEST(Server, ReplacesASocketThatNobodyServes) {
  TestServer server;
  const std::string path = server.path + ".stale";
  std::filesystem::create_hard_link(server.path, path);
  server.stop();
  ASSERT_TRUE(std::filesystem::exists(path));
  EventLoop loop;
  {
    Service service(loop.executor(), server.table);
    LineServer second(loop, service);
    EXPECT_EQ(error_of(second.listen_unix(path)), "no error");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Server, NeverRemovesAFileThatIsNotASocket) {
  TestServer server;
  const std::string path = server.path + ".txt";
  std::ofstream(path) << "precious";
  EXPECT_NE(error_of(server.server->listen_unix(path)).find("is not a socket"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(path));
  std::filesystem::remove(path);
}

TEST(Server, NamesTheErrorInAPath) {
  TestServer server;
  EXPECT_NE(error_of(server.server->listen_unix("/tmp/" + std::string(200, 'p')))
                .find("has 205 bytes, but must have 1 to 107"),
            std::string::npos);
  EXPECT_NE(error_of(server.server->listen_unix("/nowhere/at/all.sock")).find("/nowhere/at/all"),
            std::string::npos);
}

TEST(Server, AcceptsAListeningSocket) {
  TestServer server;
  auto listening = listen_on_unix(server.path + ".activated");
  ASSERT_TRUE(listening.has_value());
  EXPECT_EQ(error_of(server.server->listen_fd(listening->release())), "no error");
  server.start();
  EXPECT_EQ(at(RawClient(server.path + ".activated").ask(kGood), "/id"), "1");
  std::filesystem::remove(server.path + ".activated");
}

TEST(Server, RejectsADescriptorThatDoesNotListen) {
  TestServer server;
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM, 0));
  EXPECT_NE(error_of(server.server->listen_fd(socket.get())).find("not a listening"),
            std::string::npos);
  EXPECT_FALSE(server.server->listen_fd(-1).has_value());
}

class OverTcp : public ::testing::Test {
 protected:
  static ServerOptions options(bool may_write) {
    ServerOptions o;
    o.tcp_may_write = may_write;
    return o;
  }
  static std::string write_with(bool may_write, bool tcp) {
    TestServer server(options(may_write));
    server.table.add({.name = "write",
                      .summary = "Writes.",
                      .result = "who",
                      .writes = true,
                      .handler = [](const Params& p) -> Result<std::string> {
                        const auto who = p.caller().credentials();
                        if (!who) return "null";
                        return "[" + std::to_string(who->uid) + "," + std::to_string(who->pid) +
                               "]";
                      }});
    const auto port = server.server->listen_tcp("127.0.0.1", 0);
    EXPECT_TRUE(port.has_value());
    server.start();
    RawClient client = tcp ? tcp_client(*port) : RawClient(server.path);
    EXPECT_EQ(at(client.ask(kGood), "/id"), "1");
    return client.ask(R"({"jsonrpc":"2.0","method":"write","id":2})");
  }
};

TEST_F(OverTcp, MethodsReadButDoNotWriteUnlessConfigured) {
  EXPECT_EQ(at(write_with(false, true), "/error/code"), "-32003");
  EXPECT_EQ(at(write_with(true, true), "/result"), "null");
}

TEST_F(OverTcp, OnlyTheUnixSocketIdentifiesTheCaller) {
  EXPECT_EQ(at(write_with(false, false), "/result"),
            "[" + std::to_string(::getuid()) + "," + std::to_string(::getpid()) + "]");
}

TEST_F(OverTcp, OnlyLoopbackIsServed) {
  TestServer server;
  for (const char* address : {"0.0.0.0", "::", "192.168.1.1", "localhost", ""})
    EXPECT_FALSE(server.server->listen_tcp(address, 0).has_value()) << address;
}

TEST(Client, StatesHowToStartADaemonThatDoesNotRun) {
  const auto client = Client::connect("/tmp/mdof-nothing-here.sock");
  ASSERT_FALSE(client.has_value());
  EXPECT_EQ(client.error().code, ErrorCode::io);
  EXPECT_NE(client.error().message.find("systemctl start mdofd"), std::string::npos);
}

TEST(Client, ReturnsResultsUnchanged) {
  TestServer server;
  server.start();
  auto client = Client::connect(server.path);
  ASSERT_TRUE(client.has_value());
  EXPECT_EQ(*client->call("echo", R"({"value":{"x":[0.1,-25,"µ"]}})"), R"({"x":[0.1,-25,"µ"]})");
  const auto missed = client->call("get_dat");
  ASSERT_FALSE(missed.has_value());
  EXPECT_EQ(missed.error().code, ErrorCode::usage);
  EXPECT_EQ(missed.error().message, "Method not found: did you mean \"get_data\"?");
}

TEST(Client, StatesWhyTheServerClosed) {
  TestServer server;
  server.start();
  auto client = Client::connect(server.path);
  ASSERT_TRUE(client.has_value());
  const auto result =
      client->call("echo", "{\"value\":{\"x\":\"" + std::string(1 << 20, 'x') + "\"}}");
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().message.find("the request line is too long (limit 65536 bytes)"),
            std::string::npos)
      << result.error().message;
  EXPECT_FALSE(client->call("get_data").has_value());
}

TEST(Client, DoesNotWaitIndefinitely) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("mdof-rpc-deaf-" + std::to_string(::getpid()));
  const auto deaf = listen_on_unix(path);
  ASSERT_TRUE(deaf.has_value());
  auto client = Client::connect(path);
  ASSERT_TRUE(client.has_value());
  const auto result = client->call("get_data", "{}", 30ms);
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().message.find("did not answer in time"), std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace mdof::rpc::test
