// Devices whose sampling interval is longer than max_gap_s. max_gap_s of these channels is
// increased to suit the rate of the device, or the configuration is rejected.
#include "daemon/measure/configuration/slow_channels.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

drivers::DeviceInfo device(const std::string& name, double rate_hz,
                           const std::vector<std::string>& channels) {
  drivers::DeviceInfo info;
  info.name = name;
  info.rate_hz = rate_hz;
  for (const auto& id : channels) info.channels.push_back({id, Unit::um});
  return info;
}

TEST(SlowChannels, OnlySlowChannelsGetALargerMaxGap) {
  const auto align = with_intervals({}, {device("adam", 10, {"A", "B"}), device("t7", 1000, {"C"}),
                                         device("script", 0, {"D"}), device("ad7746", 45, {"E"})});
  EXPECT_DOUBLE_EQ(align.gap_s("A"), 0.25);
  EXPECT_DOUBLE_EQ(align.gap_s("B"), 0.25);
  EXPECT_EQ(align.gap_s("C"), 0.05);
  EXPECT_EQ(align.gap_s("D"), 0.05);
  EXPECT_NEAR(align.gap_s("E"), 0.0556, 1e-4);
  EXPECT_EQ(align.interval_s.size(), 3u);
}

TEST(SlowChannels, RejectsAnImpossibleRateWithTheRemedy) {
  const auto adam = device("adam", 10, {"A"});
  EXPECT_TRUE(check_rate(adam, {}, false));
  EXPECT_TRUE(check_rate(adam, {.max_gap_s = 0.1}, true));
  EXPECT_TRUE(check_rate(device("script", 0, {"A"}), {.max_gap_s = 0.001}, true));
  const auto gap = check_rate(adam, {.max_gap_s = 0.05}, true);
  ASSERT_FALSE(gap);
  EXPECT_NE(gap.error().message.find(
                "device \"adam\": max_gap_s = 0.05 s is shorter than the interval between "
                "samples (0.1 s)"),
            std::string::npos);
  EXPECT_NE(gap.error().message.find("remove max_gap_s from [measure]"), std::string::npos);
  const auto lag = check_rate(device("logger", 0.2, {"A"}), {}, false);
  ASSERT_FALSE(lag);
  EXPECT_NE(lag.error().message.find("set lag_bound_s in [measure] to 10"), std::string::npos);
}

}  // namespace
}  // namespace mdof::daemon
