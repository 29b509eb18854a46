// TCP, serial ports and pipes: received data, time-outs, and peers that close the connection.
#include "drivers/io/byte_stream.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

struct Pair {
  ByteStream ours;
  int theirs;
};
Pair make_pair() {
  int fds[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, fds), 0);
  return {ByteStream(fds[0], "pair"), fds[1]};
}

std::string read_some(ByteStream& stream, milliseconds timeout) {
  std::array<char, 64> buffer;
  const auto n = stream.read(buffer, timeout);
  return n ? std::string(buffer.data(), *n) : "error: " + n.error().message;
}

TEST(ByteStream, ReturnsReceivedBytesOrNothing) {
  Pair pair = make_pair();
  EXPECT_EQ(read_some(pair.ours, milliseconds(1)), "");
  ASSERT_EQ(::write(pair.theirs, "abc", 3), 3);
  EXPECT_EQ(read_some(pair.ours, milliseconds(1)), "abc");
  ASSERT_TRUE(pair.ours.write("xy", milliseconds(10)));
  char two[2];
  ASSERT_EQ(::read(pair.theirs, two, 2), 2);
  EXPECT_EQ(std::string(two, 2), "xy");
  ::close(pair.theirs);
}

TEST(ByteStream, ClosedPeerIsAnErrorWithoutASignal) {
  Pair pair = make_pair();
  ::close(pair.theirs);
  EXPECT_NE(read_some(pair.ours, milliseconds(1)).find("closed the connection"), std::string::npos);
  EXPECT_FALSE(pair.ours.write("x", milliseconds(1)));
}

TEST(ByteStream, WriteFailsIfThePeerReadsNothing) {
  Pair pair = make_pair();
  const std::string much(1 << 22, 'x');
  const Status written = pair.ours.write(much, milliseconds(5));
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("accepts no more"), std::string::npos);
  ::close(pair.theirs);
}

TEST(ByteStream, DrainsUntilQuiet) {
  Pair pair = make_pair();
  ASSERT_EQ(::write(pair.theirs, "garbage", 7), 7);
  const auto drained = pair.ours.drain(milliseconds(1), milliseconds(1000));
  ASSERT_TRUE(drained);
  EXPECT_EQ(*drained, 7u);
  EXPECT_EQ(read_some(pair.ours, milliseconds(1)), "");
  ::close(pair.theirs);
}

TEST(Endpoint, ParsesEachForm) {
  EXPECT_EQ(parse_endpoint("10.0.0.5", 502)->text(), "10.0.0.5:502");
  EXPECT_EQ(parse_endpoint("probe-box:23", 502)->port, 23);
  EXPECT_EQ(parse_endpoint("[fe80::1]:7", 502)->host, "fe80::1");
  EXPECT_EQ(parse_endpoint("[fe80::1]", 502)->text(), "[fe80::1]:502");
  for (const char* bad :
       {"", ":", ":502", "a:", "a:x", "a:0", "a:70000", "[fe80::1", "a:1:2", "[]:3"})
    EXPECT_FALSE(parse_endpoint(bad, 502)) << bad;
}

// Binds a socket to a free port of this computer.
Endpoint bind_somewhere(int server) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(::bind(server, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(::getsockname(server, reinterpret_cast<sockaddr*>(&address), &size), 0);
  return {"127.0.0.1", ntohs(address.sin_port)};
}

TEST(Tcp, ConnectsOrStatesTheReason) {
  const int server = ::socket(AF_INET, SOCK_STREAM, 0);
  const Endpoint to = bind_somewhere(server);
  const auto refused = connect_tcp(to, milliseconds(500));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find(to.text()), std::string::npos);
  EXPECT_NE(refused.error().message.find("the device is switched on"), std::string::npos);
  ASSERT_EQ(::listen(server, 1), 0);
  const auto connected = connect_tcp(to, milliseconds(500));
  ASSERT_TRUE(connected) << connected.error().message;
  EXPECT_EQ(connected->name(), to.text());
  ::close(server);
}

// The kernel notes the first times some time after keep_arrival_times(), so the test sends several
// bytes.
TEST(Tcp, TimeOfArrivalIsKeptUntilTheBytesAreRead) {
  const int server = ::socket(AF_INET, SOCK_STREAM, 0);
  const Endpoint to = bind_somewhere(server);
  ASSERT_EQ(::listen(server, 1), 0);
  auto ours = connect_tcp(to, milliseconds(500));
  ASSERT_TRUE(ours) << ours.error().message;
  const int theirs = ::accept(server, nullptr, nullptr);
  ours->keep_arrival_times();
  bool kept = false;
  for (int i = 0; i < 100 && !kept; ++i) {
    const auto sent = steady_clock::now();
    ASSERT_EQ(::write(theirs, "a", 1), 1);
    pollfd arrives{ours->fd(), POLLIN, 0};
    ASSERT_EQ(::poll(&arrives, 1, 20'000), 1);
    const auto arrived = steady_clock::now();
    std::this_thread::sleep_for(milliseconds(20));
    ASSERT_EQ(read_some(*ours, milliseconds(0)), "a");
    const auto slack = milliseconds(1);  // between the two clocks of the computer
    kept = sent - slack <= ours->arrival() && ours->arrival() <= arrived + slack;
  }
  EXPECT_TRUE(kept);
  ::close(theirs);
  ::close(server);
}

TEST(Serial, OpensAPtyAndRefusesASecondProgram) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(::grantpt(master) + ::unlockpt(master), 0);
  const std::string path = ::ptsname(master);
  {
    auto port = open_serial(path, {.baud = 19200, .parity = 'E'});
    ASSERT_TRUE(port) << port.error().message;
    EXPECT_EQ(read_some(*port, milliseconds(1)), "");
    ASSERT_EQ(::write(master, "\r\n\x01\x7f", 4), 4);
    // The port is in raw mode, so all bytes arrive unchanged.
    EXPECT_EQ(read_some(*port, milliseconds(100)), "\r\n\x01\x7f");
    const auto second = open_serial(path, {});
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("in use"), std::string::npos) << second.error().message;
    pulse_dtr(*port);
  }
  ::close(master);
  EXPECT_NE(open_serial("/dev/no-such-port", {}).error().message.find("does not exist"),
            std::string::npos);
  EXPECT_NE(
      open_serial(path, {.baud = 12345}).error().message.find("baud = 12345 is not supported"),
      std::string::npos);
}

}  // namespace
}  // namespace mdof::drivers
