// Two programs want to use one device. The second program gets an error with the name of the
// first.
#include "drivers/io/device_lock.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

namespace mdof::drivers {
namespace {

// A name that no test that runs at the same time uses.
std::string fresh(const std::string& name) {
  return name + " of test " + std::to_string(::getpid());
}

// Another program that holds the lock of `identity` until this object is destroyed.
class Holder {
 public:
  explicit Holder(const std::string& identity) {
    std::array<int, 2> ready{};
    EXPECT_EQ(::pipe(ready.data()), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      const auto lock = DeviceLock::take(identity);
      (void)!::write(ready[1], lock ? "1" : "0", 1);
      for (;;) ::pause();
    }
    char answer = 0;
    EXPECT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, '1');
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

bool free_again(const std::string& identity) {
  return DeviceLock::take(identity).has_value();
}

TEST(DeviceLock, NamesTheProgramThatHoldsTheDevice) {
  const std::string identity = fresh("tcp 192.0.2.7:502");
  Holder holder(identity);
  const auto refused = DeviceLock::take(identity);
  ASSERT_FALSE(refused);
  const std::string process = "(process " + std::to_string(holder.pid()) + ")";
  EXPECT_NE(refused.error().message.find(process), std::string::npos) << refused.error().message;
  EXPECT_EQ(refused.error().remedy, Remedy::ask_daemon_for_device);
  EXPECT_TRUE(free_again(identity + "0"));
  holder.kill();  // simulates a crash
  EXPECT_TRUE(free_again(identity));
}

TEST(DeviceLock, RefusesADeviceTwiceInOneProgram) {
  const std::string identity = fresh("tcp 192.0.2.8:502");
  auto held = DeviceLock::take(identity);
  ASSERT_TRUE(held);
  const auto refused = DeviceLock::take(identity);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("two devices"), std::string::npos);
  DeviceLock moved = std::move(*held);
  EXPECT_FALSE(free_again(identity));
}

TEST(DeviceLock, AnswersAnyNumberOfInquiries) {
  const std::string identity = fresh("tcp 192.0.2.9:502");
  auto held = DeviceLock::take(identity);
  ASSERT_TRUE(held);
  for (int i = 0; i < 300; ++i) {
    if (i % 40 == 0) held->answer_inquiries();
    const auto refused = DeviceLock::take(identity);
    ASSERT_FALSE(refused);
    ASSERT_NE(refused.error().message.find("two devices"), std::string::npos) << i;
  }
}

TEST(DeviceLock, LongNamesCanBeLocked) {
  const std::string identity = fresh(std::string(5000, 'x'));
  auto held = DeviceLock::take(identity);
  ASSERT_TRUE(held);
  EXPECT_FALSE(free_again(identity));
  EXPECT_TRUE(free_again(identity + "y"));
}

TEST(DeviceLock, OneDeviceHasOneIdentity) {
  const auto folder = std::filesystem::temp_directory_path() / fresh("lock");
  std::filesystem::create_directories(folder);
  std::filesystem::create_symlink("/dev/null", folder / "by-id");
  EXPECT_EQ(identity_of_path(folder / "by-id"), "/dev/null");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(identity_of(Endpoint{"127.0.0.1", 502}), "tcp 127.0.0.1:502");
  EXPECT_EQ(identity_of(Endpoint{"127.1", 502}), "tcp 127.0.0.1:502");
  EXPECT_EQ(identity_of(Endpoint{"::1", 502}), "tcp [::1]:502");
}

}  // namespace
}  // namespace mdof::drivers
