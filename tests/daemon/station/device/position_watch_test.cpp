// Reports about an encoder that sends no positions.
#include "daemon/station/device/position_watch.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

// 0.1 s of samples. NaN: the encoder sends no position.
SampleBlock block(int number, double position_mm, const char* channel = kEncoderChannel) {
  SampleBlock block{"daq", {{"A", Unit::um}, {channel, Unit::mm}}, {}, {{}, {}}, {}, 0};
  for (int i = 0; i < 10; ++i) {
    block.time_ns.push_back((std::int64_t{10} * number + i) * 10'000'000);
    block.value[0].push_back(1);
    block.value[1].push_back(position_mm);
  }
  return block;
}

TEST(PositionWatch, ReportsOnceThatNoPositionCameForASecondAndThatPositionsComeAgain) {
  PositionWatch watch;
  EXPECT_FALSE(watch.take(block(0, 5)));
  for (int n = 1; n < 10; ++n) EXPECT_FALSE(watch.take(block(n, kNaN))) << n;
  const auto lost = watch.take(block(10, kNaN));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->kind, Trouble::Kind::position);
  EXPECT_EQ(lost->channel, kEncoderChannel);
  for (int n = 11; n < 40; ++n) EXPECT_FALSE(watch.take(block(n, kNaN))) << n;
  const auto back = watch.take(block(40, 5));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->kind, Trouble::Kind::back);
  EXPECT_EQ(back->channel, kEncoderChannel);
  EXPECT_FALSE(watch.take(block(41, 5)));
}

TEST(PositionWatch, ReportsAnEncoderThatNeverSentAPosition) {
  PositionWatch watch;
  int reports = 0;
  for (int n = 0; n < 20; ++n) reports += watch.take(block(n, kNaN)).has_value();
  EXPECT_EQ(reports, 1);
}

TEST(PositionWatch, IgnoresADeviceWithoutAnEncoder) {
  PositionWatch watch;
  for (int n = 0; n < 20; ++n) EXPECT_FALSE(watch.take(block(n, kNaN, "B")));
}

}  // namespace
}  // namespace mdof::daemon
