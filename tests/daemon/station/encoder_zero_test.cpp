// A user sets the position of an axis: find() calculates the offset of the encoder, put() applies
// it. If the position is lost later, a notice reports the loss.
#include "daemon/station/encoder_zero.h"

#include <gtest/gtest.h>

#include "daemon/words/words.h"
#include "drivers/clock/monotonic.h"

namespace mdof::daemon {
namespace {

drivers::DriverSpec counting() {
  drivers::DriverSpec device;
  device.driver = device.name = "t7";
  device.channels = {kEncoderChannel};
  device.encoder.counts = true;
  return device;
}

// 0.3 s of samples of an axis at rest. The last sample is now.
SampleBlock resting_at(double mm) {
  SampleBlock block{"t7", {{kEncoderChannel, Unit::mm}}, {}, {{}}, {{}}, 0};
  const std::int64_t end_ns = drivers::monotonic_ns();
  for (int i = 300; i > 0; --i) {
    block.time_ns.push_back(end_ns - i * 1'000'000);
    block.value[0].push_back(mm);
    block.quality[0].push_back(Quality::good);
  }
  return block;
}

DatumSetting said(double position_m) {
  return {1, mdof::Axis::y, "t7", 0, position_m, position_m, "2026-11-01T06:00:00Z"};
}

TEST(EncoderZero, AFoundOffsetIsAppliedOnlyAfterPut) {
  EncoderZero zero({counting()});
  SampleBlock block = resting_at(3);
  zero.apply(block);
  const auto found = zero.find(mdof::Axis::y, 0.0125, "2026-11-23T07:00:00Z");
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->before_m, 0.003, 1e-12);
  EXPECT_NEAR(found->offset_m, 0.0095, 1e-12);
  EXPECT_EQ(found->axis, mdof::Axis::y);
  EXPECT_EQ(found->device, "t7");
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
  block = resting_at(3);
  zero.apply(block);
  EXPECT_EQ(block.value[0][0], 3);
  ASSERT_TRUE(zero.put(*found, "uid 1000"));
  block = resting_at(3);
  zero.apply(block);
  EXPECT_NEAR(block.value[0][0], 12.5, 1e-9);
  EXPECT_EQ(zero.state().note, "set to 12.5 mm on 2026-11-23T07:00:00Z by uid 1000");
}

TEST(EncoderZero, OffsetOfAPositionInVoltsUsesItsScale) {
  EncoderZero zero({counting()}, std::nullopt, -500);
  SampleBlock block = resting_at(2);
  block.channels[0].unit = Unit::volt;  // 2 V at -500 um/V are -1 mm
  zero.apply(block);
  const auto found = zero.find(mdof::Axis::x, 0.004, "now");
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->before_m, -0.001, 1e-12);
  ASSERT_TRUE(zero.put(*found, "me"));
  block = resting_at(2);
  block.channels[0].unit = Unit::volt;
  zero.apply(block);
  EXPECT_NEAR(block.value[0][0] * -500, 4000, 1e-6);
}

TEST(EncoderZero, ASecondSettingStartsFromTheCurrentOne) {
  EncoderZero zero({counting()});
  for (const double position_m : {0.0125, 0.1}) {
    SampleBlock block = resting_at(3);
    zero.apply(block);
    ASSERT_TRUE(zero.put(zero.find(mdof::Axis::y, position_m, "now").value(), "me"));
  }
  EXPECT_NEAR(zero.datum().offset_m, 0.097, 1e-12);
}

TEST(EncoderZero, AnOffsetFoundBeforeALossIsRejected) {
  EncoderZero zero({counting()});
  SampleBlock block = resting_at(3);
  zero.apply(block);
  const auto found = zero.find(mdof::Axis::y, 0.0125, "now");
  ASSERT_TRUE(found);
  zero.lose("t7");
  const auto put = zero.put(*found, "me");
  ASSERT_FALSE(put);
  EXPECT_EQ(put.error().code, ErrorCode::conflict);
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
}

TEST(EncoderZero, ItsCountContinuesFromItsStartOrLastLoss) {
  EncoderZero zero({counting()});
  EXPECT_FALSE(zero.has_counted_since(6));  // datum from an earlier start of mdofd
  zero.begins(7);
  EXPECT_TRUE(zero.has_counted_since(7));
  SampleBlock block = resting_at(3);
  zero.apply(block);
  zero.lose("another");
  EXPECT_TRUE(zero.has_counted_since(7));
  zero.lose("t7");
  EXPECT_FALSE(zero.has_counted_since(7));
  zero.begins(8);
  EXPECT_TRUE(zero.has_counted_since(8));
  EXPECT_FALSE(zero.has_counted_since(7));
  auto absolute = counting();
  absolute.encoder.counts = false;
  EXPECT_TRUE(EncoderZero({absolute}).has_counted_since(6));
}

// The notice that Y has lost its position 12.5 mm. The parameters give the cause of the loss.
Notice lost_position(const char* utc, bool without_power, bool configured, bool counted) {
  return notice(NoticeCode::position_lost, "Y",
                {{"position_mm", 12.5},
                 {"utc", utc},
                 {"without_power", without_power ? 1 : 0},
                 {"configured", configured ? 1 : 0},
                 {"counted", counted ? 1 : 0}});
}

TEST(EncoderZero, ReportsThePositionLostByARestart) {
  EXPECT_EQ(EncoderZero({counting()}).state().notice, notice(NoticeCode::datum_missing, "t7"));
  const auto lost = [](bool configured, bool counted) {
    return lost_position("2026-11-01T06:00:00Z", false, configured, counted);
  };
  EXPECT_EQ(EncoderZero({counting()}, said(0.0125)).state().notice, lost(false, true));
  auto configured = counting();
  configured.encoder.offset_mm = 5;
  EXPECT_EQ(EncoderZero({configured}).state().notice, std::nullopt);
  EXPECT_EQ(EncoderZero({configured}, said(0.0125)).state().notice, lost(true, false));
  auto absolute = counting();
  absolute.encoder.counts = false;
  const EncoderState state = EncoderZero({absolute}, said(0.0125)).state();
  EXPECT_EQ(state.notice, lost(false, false));
  EXPECT_EQ(state.note, words::text(*state.notice));
  EXPECT_EQ(EncoderZero({absolute}).state().notice, std::nullopt);
  EXPECT_EQ(EncoderZero({absolute}).state().note, "");
}

TEST(EncoderZero, NoticeStatesThatThePositionWasLostWithPower) {
  EncoderZero zero({counting()}, said(0.5));
  SampleBlock block = resting_at(3);
  zero.apply(block);
  ASSERT_TRUE(zero.put(zero.find(mdof::Axis::y, 0.0125, "2026-11-23T07:00:00Z").value(), "me"));
  EXPECT_EQ(zero.state().notice, std::nullopt);
  zero.lose("t7");
  EXPECT_EQ(zero.state().notice, lost_position("2026-11-23T07:00:00Z", true, false, true));
  EXPECT_EQ(zero.datum().offset_m, 0);
  block = resting_at(3);
  zero.apply(block);
  EXPECT_EQ(block.value[0][0], 3) << "the position of the device, as the notice states";
}

drivers::DriverSpec with_mark() {
  auto device = counting();
  device.encoder.index_mm = 12.5;
  return device;
}

TEST(EncoderZero, AfterTheMarkPositionsAreMachinePositions) {
  EncoderZero zero({with_mark()});
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
  EXPECT_EQ(zero.state().notice, notice(NoticeCode::reference_mark_not_passed, "t7"));
  SampleBlock block = resting_at(3);
  zero.apply(block);
  EXPECT_EQ(block.value[0][0], 3);
  EXPECT_FALSE(zero.pass_mark("probes", "now"));
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
  ASSERT_TRUE(zero.pass_mark("t7", "2026-11-23T07:00:00Z"));
  block = resting_at(3);
  zero.apply(block);
  EXPECT_NEAR(block.value[0][0], 15.5, 1e-9);
  EXPECT_EQ(zero.datum(),
            (EncoderDatum{EncoderDatum::Kind::index, 0.0125, "t7", "2026-11-23T07:00:00Z", ""}));
  EXPECT_EQ(zero.state().note, "reference mark at 12.5 mm, passed on 2026-11-23T07:00:00Z");
}

TEST(EncoderZero, WithoutAMarkNoMarkIsPassed) {
  EncoderZero zero({counting()});
  EXPECT_FALSE(zero.pass_mark("t7", "now"));
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
}

TEST(EncoderZero, TheMarkIsLostWithPowerAndCanBePassedAgain) {
  EncoderZero zero({with_mark()}, said(0.5));
  ASSERT_TRUE(zero.pass_mark("t7", "now"));
  zero.lose("t7");
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::none);
  EXPECT_EQ(zero.datum().offset_m, 0);
  EXPECT_EQ(zero.state().notice, notice(NoticeCode::reference_mark_not_passed, "t7"));
  ASSERT_TRUE(zero.pass_mark("t7", "later"));
  EXPECT_EQ(zero.state().note, "reference mark at 12.5 mm, passed on later");
}

TEST(EncoderZero, AnOffsetFoundBeforeTheMarkIsRejected) {
  EncoderZero zero({with_mark()});
  SampleBlock block = resting_at(3);
  zero.apply(block);
  const auto found = zero.find(mdof::Axis::y, 0.1, "now");
  ASSERT_TRUE(found);
  ASSERT_TRUE(zero.pass_mark("t7", "now"));
  EXPECT_FALSE(zero.put(*found, "me"));
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::index);
  // Readings at rest from before the mark cannot be used, even in a new search.
  EXPECT_FALSE(zero.find(mdof::Axis::y, 0.1, "now"));
  // If a user sets a position after the mark was passed, this position replaces the datum of the
  // mark.
  block = resting_at(3);
  zero.apply(block);
  ASSERT_TRUE(zero.put(zero.find(mdof::Axis::y, 0.1, "now").value(), "me"));
  EXPECT_EQ(zero.datum().kind, EncoderDatum::Kind::set);
  EXPECT_NEAR(zero.datum().offset_m, 0.097, 1e-12);
}

}  // namespace
}  // namespace mdof::daemon
