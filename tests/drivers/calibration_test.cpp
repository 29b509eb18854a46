// Calibration of readings and encoder positions: missing values, units, scales.
#include "drivers/calibration.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mdof::drivers {
namespace {

Rig rig_with(const std::string& more) {
  const auto rig = parse_rig(
      "name = \"r\"\naxis = \"X\"\n[[probe]]\nid = \"A\"\nposition_mm = [0, 0, 0]\n"
      "measures = \"+Z\"\nrange_um = 200\n" +
          more,
      "r.toml");
  EXPECT_TRUE(rig) << rig.error().message;
  return *rig;
}

SampleBlock block_of(const Channel& channel, const std::vector<double>& values) {
  SampleBlock block;
  block.device = "d";
  block.channels = {channel};
  block.value = {values};
  for (std::size_t i = 0; i < values.size(); ++i)
    block.time_ns.push_back(static_cast<std::int64_t>(i));
  return block;
}

TEST(Calibration, MissingValueStaysMissing) {
  for (const char* more :
       {"", "offset_um = 3\n", "reads = \"gap\"\n", "polynomial_um = [0.1, 0.001]\n",
        "linearity = [[-100, 0.5], [0, 0], [100, -0.5]]\n"}) {
    SampleBlock block = block_of({"A", Unit::um}, {50, kNaN, 60});
    ASSERT_TRUE(Calibrator(rig_with(more)).apply(block)) << more;
    EXPECT_TRUE(std::isnan(block.value[0][1])) << more;
    EXPECT_EQ(block.quality_at(0, 1), Quality::missing) << more;
    EXPECT_EQ(block.quality_at(0, 0), Quality::good) << more;
    EXPECT_TRUE(std::isfinite(block.value[0][2])) << more;
  }
}

// Calculated by hand. Each limit is inside the range by 0.05 % of the range (200 um). With reads =
// "gap", a reading increases when the target recedes.
TEST(Calibration, WindowLimitsAreDisplacementsInAscendingOrder) {
  const auto expect = [](const std::string& more, double low_um, double high_um) {
    const auto [low_m, high_m] = displacement_window_m(rig_with(more).probes[0]);
    EXPECT_NEAR(low_m, low_um * 1e-6, 1e-12) << more;
    EXPECT_NEAR(high_m, high_um * 1e-6, 1e-12) << more;
  };
  expect("", -99.95, 99.95);
  expect("offset_um = 10\n", -109.95, 89.95);
  expect("reads = \"gap\"\noffset_um = 120\n", 120 - 199.9, 120 - 0.1);
  expect("valid_um = [-50, 80]\n", -50, 80);
}

TEST(Calibration, ChannelsThatTheRigDoesNotDescribeAreNamed) {
  const Rig rig = rig_with("");
  EXPECT_TRUE(
      unused_channels(rig, {{"A", Unit::um}, {"encoder", Unit::mm}, {"air", Unit::deg_c}}).empty());
  const Notices found = unused_channels(
      rig, {{"F", Unit::um}, {"A", Unit::um}, {"G", Unit::volt}, {"load", Unit::other}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(test::shown(found[0]), "channels_not_in_rig channels=F, G");
  EXPECT_EQ(found[0].severity, Severity::information);
}

// A laboratory's um_per_V applies to volts, and must not be used for a reading that the amplifier
// has converted to a length. If um_per_V is in the rig and not in a record, um_per_V may be for
// logs in volts; then there is no notice.
TEST(Calibration, ScaleOfARecordDoesNotApplyToALength) {
  Rig rig = rig_with("um_per_V = 20\n");
  EXPECT_TRUE(unused_scales(rig, {{"A", Unit::um}}).empty());
  rig.probes[0].calibration.scale_record = "sensitivity-7";
  EXPECT_TRUE(unused_scales(rig, {{"A", Unit::volt}, {"B", Unit::um}}).empty());
  for (const Unit unit : {Unit::um, Unit::mm}) {
    const Notices said = unused_scales(rig, {{"B", Unit::volt}, {"A", unit}});
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].code, NoticeCode::scale_not_used);
    EXPECT_EQ(said[0].severity, Severity::doubtful);
    EXPECT_EQ(said[0].subject, "A");
    EXPECT_EQ(test::shown(said[0]), "scale_not_used A record=sensitivity-7");
  }
}

TEST(Calibration, ConvertsPositionsInVoltsWithTheRigsScale) {
  for (const double um_per_V : {5000.0, -250.0}) {
    const Rig rig = rig_with("[encoder]\num_per_V = " + std::to_string(um_per_V) + "\n");
    SampleBlock block = block_of({kEncoderChannel, Unit::volt}, {2, -1.5, kNaN});
    ASSERT_TRUE(Calibrator(rig).apply(block));
    EXPECT_DOUBLE_EQ(block.value[0][0], 2e-6 * um_per_V);
    EXPECT_DOUBLE_EQ(block.value[0][1], -1.5e-6 * um_per_V);
    EXPECT_TRUE(std::isnan(block.value[0][2]));
    EXPECT_EQ(block.channels[0].unit, Unit::metre);
    // The scale applies to volts only.
    SampleBlock length = block_of({kEncoderChannel, Unit::mm}, {12.5});
    ASSERT_TRUE(Calibrator(rig).apply(length));
    EXPECT_EQ(length.value[0][0], 0.0125);
    for (const Unit unit : {Unit::deg_c, Unit::other})
      EXPECT_FALSE(Calibrator(rig).check({{kEncoderChannel, unit}}));
    EXPECT_TRUE(Calibrator(rig).check({{kEncoderChannel, Unit::volt}}));
  }
  const Status refused = Calibrator(rig_with("")).check({{kEncoderChannel, Unit::volt}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("set um_per_V in [encoder] of "), std::string::npos)
      << refused.error().message;
}

TEST(Calibration, AcceptsPositionsInUnitsOfLengthOnly) {
  const Calibrator calibrator(rig_with(""));
  for (const auto& [unit, value] :
       {std::pair{Unit::mm, 12.5}, {Unit::um, 12500.0}, {Unit::metre, 0.0125}}) {
    SampleBlock block = block_of({kEncoderChannel, unit}, {value});
    ASSERT_TRUE(calibrator.apply(block));
    EXPECT_EQ(block.value[0][0], 0.0125);
    EXPECT_EQ(block.channels[0].unit, Unit::metre);
  }
  for (const Unit unit : {Unit::volt, Unit::deg_c, Unit::other}) {
    SampleBlock block = block_of({kEncoderChannel, unit}, {12.5});
    const Status done = calibrator.apply(block);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("\"encoder\""), std::string::npos) << done.error().message;
    EXPECT_NE(done.error().message.find("um_per_count"), std::string::npos);
    EXPECT_NE(done.error().message.find("device \"d\""), std::string::npos);
  }
}

}  // namespace
}  // namespace mdof::drivers
