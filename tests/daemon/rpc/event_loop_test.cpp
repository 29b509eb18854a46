#include "daemon/rpc/event_loop.h"

#include <gtest/gtest.h>

#include <csignal>
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

TEST(EventLoop, CallsAtAPeriodAndLeavesMissedTicksOut) {
  EventLoop loop;
  int calls = 0;
  const auto begin = std::chrono::steady_clock::now();
  loop.call_every(20ms, [&] {
    if (++calls == 1) std::this_thread::sleep_for(110ms);  // five ticks go by
    if (calls == 4) loop.stop();
  });
  loop.run();
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 170ms);
}

TEST(EventLoop, TurnsSignalsIntoCalls) {
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

TEST(EventLoop, DropsWorkThatComesAfterItsEnd) {
  auto token = std::make_shared<int>(1);
  std::shared_ptr<EventLoop::Core> core;
  {
    EventLoop loop;
    core = loop.core();
    loop.post([token] {});  // never run, but destroyed
  }
  EXPECT_EQ(token.use_count(), 1);
}

}  // namespace
}  // namespace mdof::rpc
