// The option delay_us of channels: invalid values, the resulting options of the alignment, and the
// effect on a run.
#include "daemon/measure/delays.h"
#include "daemon/words/error_text.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

Rig two_probes() {
  Rig rig;
  rig.source = "rig.toml";
  rig.probes.resize(2);
  rig.probes[0].id = "A";
  rig.probes[1].id = "B";
  return rig;
}

Status read_with(const std::string& text, ChannelDelays& delays) {
  auto device = TomlTable::parse(text, "mdofd.toml").value();
  read_delays(device, two_probes(), 0.1, delays);
  for (auto& channel : device.tables("channel")) channel.string("input", "");
  return device.finish();
}

TEST(Delays, AreReadForEachChannel) {
  ChannelDelays delays = {{"encoder", 0.001}};
  const auto read = read_with(
      "channel = [{ id = \"A\", input = \"1\", delay_us = 3840 }, { id = \"B\" }]\n", delays);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(delays, (ChannelDelays{{"A", 0.00384}, {"encoder", 0.001}}));
  EXPECT_TRUE(read_with("channel = [{ id = \"A\", delay_us = 100_000 }]", delays));
}

TEST(Delays, RejectsInvalidValuesWithTheRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {"id = \"A\", delay_us = -1",
       "mdofd.toml:1: channel[1].delay_us: must be from 0 to 10000000"},
      {"id = \"A\", delay_us = nan", "must be a finite number"},
      {"id = \"A\", delay_us = inf", "must be a finite number"},
      {"id = \"A\", delay_us = 10_000_001", "must be from 0"},
      {"id = \"A\", delay_us = \"long\"", "delay_us"},
      {"id = \"A\", delay_us = 100_001", "settle_s in [measure] to 0.100001 or more"},
      {"id = \"encodr\", delay_us = 1", "did you mean \"encoder\"?"},
      {"id = \"Z\", delay_us = 1", "is neither a probe of rig.toml"},
      {"id = \"A\", delay_ms = 1", "did you mean \"delay_us\"?"},
  };
  for (const auto& [channel, says] : cases) {
    ChannelDelays delays;
    const auto read = read_with(std::string("channel = [{ ") + channel + " }]", delays);
    ASSERT_FALSE(read) << channel;
    EXPECT_NE(words::text(read.error()).find(says), std::string::npos) << read.error().message;
  }
}

TEST(Delays, AreCorrectedRelativeToTheEncoder) {
  const Rig rig = two_probes();
  const auto options = with_delays({}, rig, {{"A", 0.004}, {"encoder", 0.001}});
  EXPECT_EQ(options.align.delay_s, (std::map<std::string, double>{{"A", 0.003}, {"B", -0.001}}));
  EXPECT_EQ(options.dwell.leave_s, 0.004);
}

TEST(Delays, EqualDelaysLeaveTheScansUnchanged) {
  const Rig rig = two_probes();
  EXPECT_TRUE(with_delays({}, rig, {}).align.delay_s.empty());
  EXPECT_EQ(with_delays({}, rig, {}).json(), PipelineOptions().json());
  const ChannelDelays same = {{"A", 0.004}, {"B", 0.004}, {"encoder", 0.004}};
  EXPECT_TRUE(with_delays({}, rig, same).align.delay_s.empty());
  EXPECT_EQ(with_delays({}, rig, same).dwell.leave_s, 0.004);
}

TEST(Delays, TheDelayOfAProbesAmplifierIsAdded) {
  Rig rig = two_probes();
  rig.probes[1].delay_s = 0.008;
  const auto options = with_delays({}, rig, {{"A", 0.004}, {"B", 0.001}, {"encoder", 0.002}});
  EXPECT_EQ(options.align.delay_s.at("A"), 0.004 - 0.002);
  EXPECT_EQ(options.align.delay_s.at("B"), 0.008 + 0.001 - 0.002);
  EXPECT_DOUBLE_EQ(options.dwell.leave_s, 0.009);
}

TEST(Delays, AReplayUsesTheDelaysOfItsRig) {
  Rig rig = two_probes(), recorded = two_probes();
  const auto of_csv = with_delays_of(rig, Rig(), {});
  EXPECT_TRUE(of_csv.align.delay_s.empty());
  recorded.probes[0].delay_s = 0.004;
  rig.probes[0].delay_s = 0.006;
  PipelineOptions options = with_delays({}, recorded, {{"A", 0.001}});
  EXPECT_EQ(with_delays_of(recorded, recorded, options).json(), options.json());
  options = with_delays_of(rig, recorded, options);
  EXPECT_DOUBLE_EQ(options.align.delay_s.at("A"), 0.007);
  EXPECT_DOUBLE_EQ(options.dwell.leave_s, 0.007);
  EXPECT_EQ(with_delays_of(rig, Rig(), {}).align.delay_s.at("A"), 0.006);
}

TEST(Delays, TheDelayOfTheEncoderInTheRigIsSubtracted) {
  Rig rig = two_probes(), recorded = two_probes();
  rig.encoder_delay_s = 0.003;
  rig.probes[0].delay_s = 0.004;
  const auto live = with_delays({}, rig, {{"B", 0.002}, {"encoder", 0.001}});
  EXPECT_DOUBLE_EQ(live.align.delay_s.at("A"), 0.004 - 0.003 - 0.001);
  EXPECT_DOUBLE_EQ(live.align.delay_s.at("B"), 0.002 - 0.003 - 0.001);
  EXPECT_DOUBLE_EQ(live.dwell.leave_s, 0.004);
  const auto of_csv = with_delays_of(rig, Rig(), {});
  EXPECT_DOUBLE_EQ(of_csv.align.delay_s.at("A"), 0.001);
  EXPECT_DOUBLE_EQ(of_csv.align.delay_s.at("B"), -0.003);
  EXPECT_DOUBLE_EQ(of_csv.dwell.leave_s, 0.004);
  recorded.encoder_delay_s = 0.005;
  const auto replayed = with_delays_of(rig, recorded, with_delays({}, recorded, {}));
  EXPECT_DOUBLE_EQ(replayed.align.delay_s.at("B"), -0.003);
}

// Recorded: probe A 8 ms in the rig, encoder and probe B 2 ms in the device. The end of a stop that
// is left out is the longest delay of a probe.
TEST(Delays, AReplayWithSmallerDelaysLeavesOutLessOfEachStop) {
  Rig recorded = two_probes(), rig = two_probes();
  recorded.probes[0].delay_s = 0.008;
  const ChannelDelays channels = {{"B", 0.002}, {"encoder", 0.002}};
  const PipelineOptions options = with_delays({}, recorded, channels);
  EXPECT_DOUBLE_EQ(options.dwell.leave_s, 0.008);
  EXPECT_DOUBLE_EQ(with_delays_of(rig, recorded, options).dwell.leave_s, 0.002);
  rig.probes[0].delay_s = 0.003;
  EXPECT_DOUBLE_EQ(with_delays_of(rig, recorded, options).dwell.leave_s, 0.003);
  rig.probes[1].delay_s = 0.009;  // 11 ms with the delay of the channel
  EXPECT_DOUBLE_EQ(with_delays_of(rig, recorded, options).dwell.leave_s, 0.011);
}

TEST(Delays, AReplayWithoutDelaysLeavesTheScansUnchanged) {
  Rig recorded = two_probes();
  recorded.probes[0].delay_s = recorded.probes[1].delay_s = 0.004;
  const PipelineOptions options = with_delays({}, recorded, {});
  EXPECT_EQ(with_delays_of(two_probes(), recorded, options).json(), PipelineOptions().json());
}

TEST(Delays, AReplayRejectsATooShortSettlingTime) {
  PipelineOptions options = with_delays({}, two_probes(), {{"A", 0.08}});
  EXPECT_TRUE(check_settling(options));
  options.dwell.settle_s = 0.05;
  const auto checked = check_settling(options);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("settle_s = 0.05 s"), std::string::npos);
}

}  // namespace
}  // namespace mdof::daemon
