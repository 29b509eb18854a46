#include "daemon/rpc/net/event_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>
#include <thread>

namespace mdof::rpc {
namespace {

using namespace std::chrono_literals;

TEST(EventLoop, RunsWorkPostedFromOtherThreadsInOrder) {
  EventLoop loop;
  std::vector<int> seen;
  std::thread other([&] {
    for (int i = 0; i < 1000; ++i) loop.post([&seen, i] { seen.push_back(i); });
    loop.post([&] { loop.stop(); });
  });
  loop.run();
  other.join();
  ASSERT_EQ(seen.size(), 1000u);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(seen[static_cast<std::size_t>(i)], i);
}

TEST(EventLoop, CallsAtAPeriodAndSkipsMissedTicks) {
  EventLoop loop;
  int calls = 0;
  const auto begin = std::chrono::steady_clock::now();
  loop.call_every(20ms, [&] {
    // This call is so long that five ticks are missed.
    if (++calls == 1) std::this_thread::sleep_for(110ms);
    if (calls == 4) loop.stop();
  });
  loop.run();
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 170ms);
}

TEST(EventLoop, ReportsEachTimeThatDataAreReadable) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  {
    EventLoop loop;
    std::string seen;
    loop.on_readable(ends[0], [&] {
      char c = 0;
      ASSERT_EQ(::read(ends[0], &c, 1), 1);
      seen += c;
      if (seen.size() == 3) loop.stop();
    });
    loop.post([&] { (void)!::write(ends[1], "a", 1); });
    loop.call_every(5ms, [&] { (void)!::write(ends[1], "b", 1); });
    loop.run();
    EXPECT_EQ(seen, "abb");
  }
  EXPECT_EQ(::close(ends[0]), 0);  // the descriptors are still open and belong to the test
  EXPECT_EQ(::close(ends[1]), 0);
}

TEST(EventLoop, ConvertsSignalsToCalls) {
  EventLoop loop;
  int seen = 0;
  loop.on_signal({SIGUSR1}, [&](int number) {
    seen = number;
    loop.stop();
  });
  loop.post([] { std::raise(SIGUSR1); });
  loop.run();
  EXPECT_EQ(seen, SIGUSR1);
}

TEST(EventLoop, DropsWorkPostedAfterItsEnd) {
  auto token = std::make_shared<int>(1);
  std::shared_ptr<EventLoop::Core> core;
  {
    EventLoop loop;
    core = loop.core();
    loop.post([token] {});  // this task is destroyed without being run
  }
  EXPECT_EQ(token.use_count(), 1);
}

}  // namespace
}  // namespace mdof::rpc
