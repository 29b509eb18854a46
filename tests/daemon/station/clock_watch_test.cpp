#include "daemon/station/clock_watch.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000, kYears = 300'000'000 * kSecond;

TEST(ClockWatch, ReportsEachStepOnceWithItsSize) {
  ClockWatch watch;
  EXPECT_FALSE(watch.look(kYears, kSecond));
  EXPECT_FALSE(watch.look(kYears + kSecond, 2 * kSecond));
  EXPECT_EQ(watch.look(kYears + 3602 * kSecond, 3 * kSecond), 3600 * kSecond);
  EXPECT_FALSE(watch.look(kYears + 3603 * kSecond, 4 * kSecond));
  EXPECT_EQ(watch.look(4 * kSecond, 5 * kSecond), -(kYears + 3600 * kSecond));
}

// NTP slews a clock by at most 0.5 ms per second.
TEST(ClockWatch, ASlewedClockIsNotAStep) {
  ClockWatch watch;
  for (std::int64_t s = 0; s < 1000; ++s)
    EXPECT_FALSE(watch.look(kYears + s * (kSecond + 500'000), s * kSecond));
}

}  // namespace
}  // namespace mdof::daemon
