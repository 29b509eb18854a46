#include "drivers/modbus/client.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/select.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/drivers/modbus/library_server.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using Kind = LibraryServer::Kind;

Result<ModbusClient> connect(LibraryServer& server, Kind kind, milliseconds timeout, int unit = 1) {
  const ModbusClient::Options options{unit, timeout};
  return kind == Kind::tcp ? ModbusClient::over_tcp(server.connect(), options)
                           : ModbusClient::over_rtu(server.connect(), options);
}

class ModbusClientBoth : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Framings, ModbusClientBoth, testing::Values(Kind::tcp, Kind::rtu),
                         [](const auto& tried) {
                           return tried.param == Kind::tcp ? "Tcp" : "Rtu";
                         });

TEST_P(ModbusClientBoth, ReadsAndWritesRegistersOfLibmodbus) {
  LibraryServer server(GetParam());
  auto client = connect(server, GetParam(), milliseconds(200));
  ASSERT_TRUE(client) << client.error().message;
  for (const std::size_t count : {1u, 2u, 5u, 125u}) {
    std::vector<std::uint16_t> holding(count), input(count);
    ASSERT_TRUE(client->read_holding(7, holding));
    ASSERT_TRUE(client->read_input(9, input));
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(holding[i], 1007 + i);
      EXPECT_EQ(input[i], 2009 + i);
    }
  }
  const std::array<std::uint16_t, 3> written = {0xFFFF, 0, 0x8001};
  ASSERT_TRUE(client->write(20, written));
  std::array<std::uint16_t, 5> back{};
  ASSERT_TRUE(client->read_holding(19, back));
  EXPECT_EQ(back, (std::array<std::uint16_t, 5>{1019, 0xFFFF, 0, 0x8001, 1023}));
  EXPECT_TRUE(client->trusted());
  EXPECT_EQ(client->rejected(), 0u);
}

TEST_P(ModbusClientBoth, ExceptionErrorNamesItsRegisters) {
  LibraryServer server(GetParam());
  auto client = connect(server, GetParam(), milliseconds(50));
  ASSERT_TRUE(client);
  std::array<std::uint16_t, 4> into{};
  ASSERT_TRUE(client->read_input(0, into));
  const auto beyond = client->read_input(198, into);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, ErrorCode::io);
  EXPECT_EQ(beyond.error().message,
            "pair unit 1: input registers 198-201: exception 2, illegal data address");
  EXPECT_EQ(client->exception(), 2);
  EXPECT_EQ(client->rejected(), 1u);
  EXPECT_EQ(client->trusted(), GetParam() == Kind::tcp);
  ASSERT_TRUE(client->read_input(100, into));
  EXPECT_EQ(client->exception(), 0);
  EXPECT_EQ(into[3], 2103);
}

TEST_P(ModbusClientBoth, SilenceIsAnErrorWithinTheTimeOut) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  ByteStream other(ends[1], "other");
  auto client = GetParam() == Kind::tcp
                    ? ModbusClient::over_tcp(ByteStream(ends[0], "quiet"), {3, milliseconds(20)})
                    : ModbusClient::over_rtu(ByteStream(ends[0], "quiet"), {3, milliseconds(20)});
  ASSERT_TRUE(client);
  std::array<std::uint16_t, 2> into{};
  const auto start = std::chrono::steady_clock::now();
  const auto silent = client->read_holding(5, into);
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1000));
  ASSERT_FALSE(silent);
  EXPECT_NE(silent.error().message.find("quiet unit 3: holding registers 5-6: no complete reply "
                                        "within 20 ms"),
            std::string::npos)
      << silent.error().message;
  EXPECT_FALSE(client->trusted());
  EXPECT_EQ(client->exception(), 0);
}

TEST(ModbusClient, TcpClientIsUnusableAfterAnError) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  auto client = ModbusClient::over_tcp(ByteStream(ends[0], "gone"), {1, milliseconds(200)});
  ASSERT_TRUE(client);
  ::close(ends[1]);
  std::array<std::uint16_t, 2> into{};
  ASSERT_FALSE(client->read_holding(0, into));
  EXPECT_FALSE(client->trusted());
  const auto again = client->read_holding(0, into);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("open the connection again"), std::string::npos)
      << again.error().message;
}

TEST(ModbusClient, RefusesInvalidOptions) {
  for (const int unit : {-1, 0, 248, 256}) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    ByteStream other(ends[1], "other");
    const auto client = ModbusClient::over_rtu(ByteStream(ends[0], "line"), {unit, {}});
    ASSERT_FALSE(client) << unit;
    EXPECT_NE(client.error().message.find("units are from 1 to 247"), std::string::npos);
  }
}

TEST(ModbusClient, RefusesTooManyRegistersBeforeSending) {
  LibraryServer server(Kind::tcp);
  auto client = connect(server, Kind::tcp, milliseconds(200));
  ASSERT_TRUE(client);
  std::vector<std::uint16_t> into(126);
  EXPECT_FALSE(client->read_holding(0, into));
  EXPECT_FALSE(client->read_holding(0, std::span(into).first(0)));
  EXPECT_FALSE(client->read_holding(65535, std::span(into).first(2)));
  EXPECT_FALSE(client->read_holding(-1, std::span(into).first(1)));
  EXPECT_FALSE(client->write(0, std::span(into).first(124)));
  EXPECT_TRUE(client->trusted());
  EXPECT_TRUE(client->read_holding(0, std::span(into).first(2)));
}

// libmodbus aborts the program if a descriptor is too large for select().
TEST(ModbusClient, RefusesADescriptorTooLargeForSelect) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  if (before.rlim_max <= FD_SETSIZE) GTEST_SKIP() << "descriptors end at " << before.rlim_max;
  const rlimit more{std::max<rlim_t>(FD_SETSIZE + 8, before.rlim_cur), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &more), 0);
  const int high = ::fcntl(0, F_DUPFD, FD_SETSIZE);
  ASSERT_GE(high, FD_SETSIZE);
  const auto client = ModbusClient::over_tcp(ByteStream(high, "many"), {});
  ::setrlimit(RLIMIT_NOFILE, &before);
  ASSERT_FALSE(client);
  EXPECT_NE(client.error().message.find("LimitNOFILE"), std::string::npos);
}

}  // namespace
}  // namespace mdof::drivers
