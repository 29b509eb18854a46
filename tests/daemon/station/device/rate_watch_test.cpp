#include "daemon/station/device/rate_watch.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

using Kind = Trouble::Kind;

// A device with a nominal rate of 1 kHz. Each window has a length of exactly 5 s.
class RateWatchTest : public testing::Test {
 protected:
  RateWatchTest() { watch_.begin(now_); }
  std::optional<Trouble> window(std::uint64_t scans, std::uint64_t lost, bool was_slow) {
    EXPECT_FALSE(watch_.take(now_ + std::chrono::seconds(4), scans / 2, lost));
    now_ += std::chrono::seconds(5);
    EXPECT_TRUE(watch_.take(now_, scans - scans / 2, 0));
    return watch_.judge(now_, 1000, was_slow);
  }
  RateWatch watch_;
  RateWatch::Time now_;
};

TEST_F(RateWatchTest, ADeviceBelow80PercentIsSlow) {
  EXPECT_FALSE(window(4000, 0, false));
  const auto trouble = window(3999, 0, false);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, Kind::slow);
  EXPECT_TRUE(trouble->text.starts_with(
      "the device sends 799.8 scans per second instead of 1000, and 0 scans were lost in 5 s"))
      << trouble->text;
}

TEST_F(RateWatchTest, ASlowDeviceRecoversAt95Percent) {
  EXPECT_FALSE(window(4749, 0, true));
  const auto trouble = window(4750, 0, true);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, Kind::back);
}

TEST_F(RateWatchTest, LostScansAreATroubleAtFullRate) {
  const auto trouble = window(5000, 1, false);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->kind, Kind::slow);
  EXPECT_NE(trouble->text.find("and 1 scans were lost"), std::string::npos);
  EXPECT_FALSE(window(5000, 1, true));
}

}  // namespace
}  // namespace mdof::daemon
