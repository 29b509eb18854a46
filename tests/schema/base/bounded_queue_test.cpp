#include "schema/base/bounded_queue.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace mdof {
namespace {

using namespace std::chrono_literals;

TEST(BoundedQueue, CountsDroppedItemsAndReturnsTheOldestFirst) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.try_push(1));
  EXPECT_TRUE(queue.try_push(2));
  EXPECT_FALSE(queue.try_push(3));
  EXPECT_EQ(queue.dropped(), 1u);
  EXPECT_EQ(queue.pop(0ms), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(1ms), std::nullopt);
}

TEST(BoundedQueue, UnconditionalPushIgnoresTheLimit) {
  BoundedQueue<int> queue(1);
  queue.push_always(1);
  queue.push_always(2);
  EXPECT_FALSE(queue.try_push(3));
  std::deque<int> all{7};
  queue.pop_all(all, 0ms);
  EXPECT_EQ(all, (std::deque{1, 2}));
  queue.pop_all(all, 0ms);
  EXPECT_TRUE(all.empty());
}

TEST(BoundedQueue, TimedOutPushLeavesTheItemToTheCaller) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  auto first = std::make_unique<int>(1), second = std::make_unique<int>(2);
  EXPECT_TRUE(queue.push_for(first, 0ms));
  EXPECT_FALSE(queue.push_for(second, 1ms));
  EXPECT_EQ(*second, 2);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(BoundedQueue, ClosedQueueReturnsItsItemsAndAcceptsNoMore) {
  BoundedQueue<int> queue(4);
  queue.push(1);
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_FALSE(queue.try_push(2));
  queue.push_always(2);
  EXPECT_FALSE(queue.closed_and_empty());
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_TRUE(queue.closed_and_empty());
}

TEST(BoundedQueue, PushPopAndCloseWakeWaitingThreads) {
  BoundedQueue<int> queue(1);
  std::vector<int> got;
  std::thread reader([&] {
    while (const auto item = queue.pop()) got.push_back(*item);
  });
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(queue.push(i));
  queue.close();
  reader.join();
  ASSERT_EQ(got.size(), 1000u);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(got[static_cast<std::size_t>(i)], i);
  BoundedQueue<int> full(1);
  full.push(1);
  std::thread writer([&] { EXPECT_FALSE(full.push(2)); });
  full.close();
  writer.join();
}

}  // namespace
}  // namespace mdof
