#include "daemon/station/recent_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/daemon/station/fed_station.h"

namespace mdof::daemon {
namespace {

// Readings of one probe. The first reading is at `begin_ms`, and the interval is 1 ms.
FrameBlock frames(std::int64_t begin_ms, const std::vector<double>& readings_m) {
  FrameBlock block;
  for (std::size_t i = 0; i < readings_m.size(); ++i)
    block.time_ns.push_back((begin_ms + static_cast<std::int64_t>(i)) * 1'000'000);
  block.encoder_m.assign(readings_m.size(), 0.0);
  block.probe_m = {readings_m};
  return block;
}

TEST(RecentRange, IsTheRangeOfTheLastSecond) {
  RecentRange recent;
  EXPECT_TRUE(std::isnan(recent.of(0).low_m));
  recent.add(frames(0, {1.0, -7.0, 9.0, 1.0}));
  for (std::int64_t ms = 10; ms < 990; ms += 10) recent.add(frames(ms, {1.0, 2.0}));
  EXPECT_EQ(recent.of(0).low_m, -7.0);
  EXPECT_EQ(recent.of(0).high_m, 9.0);
  recent.add(frames(1000, {1.5}));
  EXPECT_EQ(recent.of(0).low_m, 1.0);
  EXPECT_EQ(recent.of(0).high_m, 2.0);
  recent.add(frames(60'000, {5.0}));  // after a pause, no earlier reading is kept
  EXPECT_EQ(recent.of(0).low_m, 5.0);
  EXPECT_EQ(recent.of(0).high_m, 5.0);
}

TEST(RecentRange, AMissingReadingDoesNotCount) {
  RecentRange recent;
  recent.add(frames(0, {kNaN, 3.0, kNaN, 2.0}));
  EXPECT_EQ(recent.of(0).low_m, 2.0);
  EXPECT_EQ(recent.of(0).high_m, 3.0);
  recent.add(frames(2000, {kNaN, kNaN}));
  EXPECT_TRUE(std::isnan(recent.of(0).high_m));
}

TEST(RecentRange, OnlyTheLastSecondOfALongBlockCounts) {
  RecentRange recent;
  std::vector<double> readings(3000, 1.0);
  readings[5] = 50;
  readings[2950] = 4;
  recent.add(frames(0, readings));
  EXPECT_EQ(recent.of(0).high_m, 4.0);
  EXPECT_EQ(recent.of(0).low_m, 1.0);
}

TEST(RecentRange, RereadingAFileStartsANewRange) {
  RecentRange recent;
  recent.add(frames(5000, {8.0}));
  recent.add(frames(0, {1.0}));
  EXPECT_EQ(recent.of(0).high_m, 1.0);
}

TEST(RecentRange, ALogMayBeginBeforeZero) {
  RecentRange recent;
  recent.add(frames(-150, {3.0, -4.0}));
  for (std::int64_t ms = -140; ms < 500; ms += 10) recent.add(frames(ms, {1.0, 2.0}));
  EXPECT_EQ(recent.of(0).low_m, -4.0);
  EXPECT_EQ(recent.of(0).high_m, 3.0);
  recent.add(frames(1000, {1.0}));
  EXPECT_EQ(recent.of(0).low_m, 1.0);
  EXPECT_EQ(recent.of(0).high_m, 2.0);
}

double number_of(const std::string& json, const std::string& member) {
  const auto at = json.find("\"" + member + "\":", json.find("\"id\":\"A\""));
  return at == std::string::npos ? kNaN
                                 : std::strtod(json.c_str() + at + member.size() + 3, nullptr);
}

// Only one scan of a probe is an outlier. An update shows the newest scan, but its range must
// contain the outlier.
TEST_F(FedStation, ASpikeBetweenTwoUpdatesIsInTheNextUpdate) {
  station_->watch(std::chrono::milliseconds(20));
  TestAxis axis(0);
  axis.stand(0.4);
  SampleBlock block = axis.block(0, 400);
  const auto probe = std::find_if(block.channels.begin(), block.channels.end(),
                                  [](const Channel& channel) { return channel.id == "A"; }) -
                     block.channels.begin();
  block.value[static_cast<std::size_t>(probe)][200] += 37;
  feed_->give(std::move(block));
  feed_->wait_until_read();
  const std::string live = events_.wait_for_live({"\"high_um\""});
  const double um = number_of(live, "um");
  EXPECT_NEAR(number_of(live, "high_um"), um + 37, 0.02);
  EXPECT_NEAR(number_of(live, "low_um"), um, 0.02);
}

}  // namespace
}  // namespace mdof::daemon
