#include "daemon/systemd/notify.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace mdof::systemd {
namespace {

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  return address;
}

int bound_socket(const std::string& path, int type) {
  const int fd = ::socket(AF_UNIX, type | SOCK_CLOEXEC, 0);
  const sockaddr_un address = address_of(path);
  ::unlink(path.c_str());
  EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0) << path;
  return fd;
}

// A service manager that receives messages and sends none.
class Notify : public testing::Test {
 protected:
  void SetUp() override {
    path_ = "/tmp/mdof-notify-" + std::to_string(::getpid());
    manager_ = bound_socket(path_, SOCK_DGRAM);
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    ::close(manager_);
    ::unlink(path_.c_str());
  }
  std::string received() {
    char text[512];
    const ssize_t size = ::recv(manager_, text, sizeof(text), MSG_DONTWAIT);
    return size < 0 ? "nothing" : std::string(text, static_cast<std::size_t>(size));
  }
  std::string path_;
  int manager_ = -1;
};

TEST_F(Notify, SendsReadinessStatusWatchdogAndStopping) {
  notify_ready("serving");
  EXPECT_EQ(received(), "READY=1\nSTATUS=serving");
  feed_watchdog();
  EXPECT_EQ(received(), "WATCHDOG=1");
  notify_stopping("closing the store");
  EXPECT_EQ(received(), "STOPPING=1\nSTATUS=closing the store");
}

TEST_F(Notify, AStatusTextCannotContainAnotherMessage) {
  notify_stopping("device \"a\nREADY=1\nb\"");
  EXPECT_EQ(received(), "STOPPING=1\nSTATUS=device \"a READY=1 b\"");
}

TEST_F(Notify, DoesNothingWithoutAServiceManager) {
  ::unsetenv("NOTIFY_SOCKET");
  notify_ready("serving");
  feed_watchdog();
  EXPECT_EQ(received(), "nothing");
  ::setenv("NOTIFY_SOCKET", "/nowhere/at/all", 1);
  notify_stopping("bye");
  EXPECT_EQ(received(), "nothing");
}

TEST_F(Notify, WatchdogIntervalIsHalfTheTimeout) {
  EXPECT_FALSE(watchdog_interval());
  ::setenv("WATCHDOG_USEC", "10000000", 1);
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  EXPECT_EQ(watchdog_interval(), std::chrono::seconds(5));
  ::setenv("WATCHDOG_PID", "1", 1);  // the watchdog of another process
  EXPECT_FALSE(watchdog_interval());
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  ::setenv("WATCHDOG_USEC", "soon", 1);
  EXPECT_FALSE(watchdog_interval());
}

// Starts a child process in the same way as systemd does: its descriptors from 3 on are `sockets`.
// The child calls take_listen_sockets() twice. Returns the results of both calls.
std::string list_child_sockets(const std::vector<int>& sockets, const char* listen_fds) {
  int pipe_fds[2];
  EXPECT_EQ(::pipe(pipe_fds), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const int out = ::fcntl(pipe_fds[1], F_DUPFD, 100);
    std::vector<int> high;
    high.reserve(sockets.size());
    for (const int fd : sockets) high.push_back(::fcntl(fd, F_DUPFD, 100));
    for (std::size_t i = 0; i < high.size(); ++i) ::dup2(high[i], 3 + static_cast<int>(i));
    ::setenv("LISTEN_PID", std::to_string(::getpid()).c_str(), 1);
    ::setenv("LISTEN_FDS", listen_fds, 1);
    std::string said;
    for (int call = 0; call < 2; ++call) {
      const auto taken = take_listen_sockets();
      if (!taken) said += taken.error().message;
      if (taken)
        for (const int fd : *taken) said += std::to_string(fd) + " ";
      said += "; ";
    }
    const bool written = ::write(out, said.data(), said.size()) == ssize_t(said.size());
    ::_exit(written ? 0 : 1);
  }
  ::close(pipe_fds[1]);
  std::string said;
  char buffer[1024];
  for (ssize_t n = 0; (n = ::read(pipe_fds[0], buffer, sizeof(buffer))) > 0;)
    said.append(buffer, static_cast<std::size_t>(n));
  ::close(pipe_fds[0]);
  int state = 0;
  ::waitpid(child, &state, 0);
  EXPECT_EQ(state, 0);
  return said;
}

class ListenSockets : public testing::Test {
 protected:
  std::string path_ = "/tmp/mdof-listen-" + std::to_string(::getpid());
  int socket_ = bound_socket(path_, SOCK_STREAM);
  void TearDown() override {
    ::close(socket_);
    ::unlink(path_.c_str());
  }
};

TEST_F(ListenSockets, AreTakenInOrderAndOnce) {
  ASSERT_EQ(::listen(socket_, 1), 0);
  EXPECT_EQ(list_child_sockets({socket_}, "1"), "3 ; ; ");
  EXPECT_EQ(list_child_sockets({socket_, socket_}, "2"), "3 4 ; ; ");
}

TEST_F(ListenSockets, AreEmptyWithoutSystemd) {
  ::unsetenv("LISTEN_FDS");
  const auto taken = take_listen_sockets();
  ASSERT_TRUE(taken);
  EXPECT_TRUE(taken->empty());
}

TEST_F(ListenSockets, RejectsSocketsThatDoNotListen) {
  EXPECT_NE(
      list_child_sockets({socket_}, "1").find("descriptor 3 is not a listening stream socket"),
      std::string::npos);
}

TEST_F(ListenSockets, TooLargeCountsAreAnErrorNotACrash) {
  ASSERT_EQ(::listen(socket_, 1), 0);
  EXPECT_NE(list_child_sockets({socket_}, "900").find("sockets from systemd"), std::string::npos);
  EXPECT_NE(list_child_sockets({socket_}, "lots").find("sockets from systemd"), std::string::npos);
}

}  // namespace
}  // namespace mdof::systemd
