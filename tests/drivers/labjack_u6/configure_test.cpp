#include "drivers/labjack_u6/configure.h"

#include <gtest/gtest.h>

namespace mdof::drivers {
namespace {

const std::string kChannels = R"(
[[channel]]
id = "A"
input = "AIN0"
[[channel]]
id = "encoder"
input = "FIO0"
um_per_count = 0.05
)";

Result<labjack_u6::Settings> read(const std::string& keys, const std::string& channels) {
  auto table = TomlTable::parse(keys + channels, "mdofd.toml");
  EXPECT_TRUE(table) << table.error().message;
  DriverContext context;
  context.name = "daq";
  context.rig.probes.resize(2);
  context.rig.probes[0].id = "A";
  context.rig.probes[1].id = "B";
  return read_labjack_u6(*table, context);
}

std::string refusal(const std::string& keys, const std::string& channels = kChannels) {
  const auto settings = read(keys, channels);
  return settings ? "accepted" : settings.error().message;
}

std::vector<int> entries(const labjack_u6::Settings& settings) {
  std::vector<int> channels;
  for (const auto& entry : labjack_u6::scan_list(settings.inputs))
    channels.push_back(entry.channel);
  return channels;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LabjackU6Configure, ReadsItsKeys) {
  const auto settings = read(
      "serial = 360012345\nrate_hz = 5000\nrange_v = 0.1\nresolution_index = 2\nsettling_us = 25\n",
      kChannels);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->name, "daq");
  EXPECT_EQ(settings->serial, "360012345");
  EXPECT_EQ(settings->rate_hz, 5000);
  EXPECT_EQ(settings->inputs[0].gain, 2);
  EXPECT_EQ(settings->resolution_index, 2);
  EXPECT_EQ(settings->settling_10us, 3);
  EXPECT_EQ(entries(*settings), (std::vector<int>{0, 200, 224}));
}

TEST(LabjackU6Configure, DefaultsSuffice) {
  const auto settings = read("", kChannels);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->serial, "");
  EXPECT_EQ(settings->rate_hz, 1000);
  EXPECT_EQ(settings->inputs[0].gain, 0);
}

TEST(LabjackU6Configure, BadValuesNameTheirKey) {
  EXPECT_TRUE(has(refusal("range_v = 5\n"), "range_v"));
  EXPECT_TRUE(has(refusal("rate_hz = 17000\n"), "mdofd.toml:1: rate_hz: must be from 1 to 16666"));
  EXPECT_TRUE(has(refusal("rate_hz = 0.5\n"), "rate_hz"));
  EXPECT_TRUE(has(refusal("resolution_index = 9\n"), "resolution_index"));
  EXPECT_TRUE(has(refusal("settling_us = 2551\n"), "settling_us"));
  EXPECT_TRUE(has(refusal("serial = -1\n"), "serial"));
  EXPECT_TRUE(has(refusal("rate = 5\n"), "rate_hz"));
}

TEST(LabjackU6Configure, RefusesBadInputs) {
  const auto channel = [](const std::string& id, const std::string& input, const char* more = "") {
    return "[[channel]]\nid = \"" + id + "\"\ninput = \"" + input + "\"\n" + more;
  };
  EXPECT_TRUE(has(refusal("", channel("A", "AIN14")), "AIN13"));
  EXPECT_TRUE(has(refusal("", channel("encoder", "AIN0", "um_per_count = 1\n")), "um_per_V"));
  const auto volts = read("", channel("A", "AIN0") + channel("encoder", "AIN1"));
  ASSERT_TRUE(volts) << volts.error().message;
  EXPECT_EQ(volts->inputs[1].channel, (Channel{"encoder", Unit::volt}));
  EXPECT_FALSE(volts->encoder.counts);
  EXPECT_TRUE(has(refusal("", channel("encoder", "FIO0")), "um_per_count"));
  EXPECT_TRUE(has(refusal("", channel("A", "AIN0", "um_per_count = 1\n")), "not counts"));
  EXPECT_TRUE(has(refusal("", channel("encoder", "FIO0", "um_per_count = 1\n")),
                  "only together with an analogue input"));
  EXPECT_TRUE(has(refusal("", channel("C", "AIN0")), "C"));
}

TEST(LabjackU6Configure, InputsMayBeDifferentialWithOwnRange) {
  const auto pair = [](const std::string& input, const std::string& negative) {
    return "[[channel]]\nid = \"B\"\ninput = \"" + input + "\"\nnegative = \"" + negative + "\"\n";
  };
  const auto s = read("range_v = 1\n", kChannels + pair("AIN2", "AIN3") + "range_v = 0.1\n");
  ASSERT_TRUE(s) << s.error().message;
  const auto list = labjack_u6::scan_list(s->inputs);
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[0].gain, 1);
  EXPECT_FALSE(list[0].differential);
  EXPECT_EQ(list[1].gain, 0);  // the counter has no gain
  EXPECT_EQ(list[3].channel, 2);
  EXPECT_EQ(list[3].gain, 2);
  EXPECT_TRUE(list[3].differential);
  EXPECT_TRUE(has(refusal("", kChannels + pair("AIN2", "AIN5")), "an even AIN and the next AIN"));
  EXPECT_TRUE(
      has(refusal("", kChannels + pair("AIN3", "AIN2")), "give negative = \"AIN3\" with AIN2"));
  EXPECT_TRUE(has(refusal("", pair("AIN0", "AIN1") + "[[channel]]\nid = \"A\"\ninput = \"AIN1\"\n"),
                  "AIN1 is the negative input of \"B\""));
  EXPECT_TRUE(has(refusal("", kChannels + pair("AIN2", "AIN3") + "range_v = 2\n"),
                  "range_v: must be 10, 1, 0.1 or 0.01"));
  EXPECT_TRUE(has(refusal("", kChannels + "range_v = 1\n"), "apply to an AIN"));
}

TEST(LabjackU6Configure, EncoderMayUseFio2) {
  const auto encoder = [](const char* id, const char* input) {
    return std::string("[[channel]]\nid = \"") + id + "\"\ninput = \"" + input +
           "\"\num_per_count = 0.05\n";
  };
  const std::string probe = "[[channel]]\nid = \"A\"\ninput = \"AIN0\"\n";
  const auto s = read("", probe + encoder("encoder", "FIO2"));
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->inputs[1].fio, 2);
  EXPECT_EQ(read("", kChannels)->inputs[1].fio, 0);
  // The first FIO pin in use has timer 0.
  EXPECT_EQ(entries(*s), (std::vector<int>{0, 200, 224}));
  EXPECT_TRUE(has(refusal("", probe + encoder("encoder", "FIO1")), "AIN13, FIO0, FIO2"));
  EXPECT_TRUE(has(refusal("", kChannels + encoder("B", "FIO2")), "the first is FIO0"));
}

TEST(LabjackU6Configure, CounterHasASpeedLimit) {
  EXPECT_EQ(read("", kChannels)->inputs[1].most_counts_per_s, 30'000);
  EXPECT_EQ(read("", kChannels + "most_counts_per_s = 5e4\n")->inputs[1].most_counts_per_s, 5e4);
  EXPECT_TRUE(has(refusal("", kChannels + "most_counts_per_s = 0\n"), "must be more than 0"));
}

TEST(LabjackU6Settings, PacketsAndTransfersFollowTheRate) {
  EXPECT_EQ(labjack_u6::samples_per_packet(50'000), 25);
  EXPECT_EQ(labjack_u6::samples_per_packet(700), 14);
  EXPECT_EQ(labjack_u6::samples_per_packet(1), 1);
  for (const double samples_hz : {1.0, 100.0, 1249.0, 1251.0, 7000.0, 50'000.0}) {
    const auto transfers = labjack_u6::transfers_for(samples_hz);
    EXPECT_EQ(transfers.bytes % 64, 0U);
    // A transfer with more than one packet has full packets only.
    EXPECT_TRUE(transfers.bytes == 64 || labjack_u6::samples_per_packet(samples_hz) == 25);
    EXPECT_GE(transfers.transfers, 4U);
  }
  const auto fast = labjack_u6::transfers_for(50'000);
  EXPECT_GE(static_cast<double>(fast.bytes * 25 * fast.transfers) / 64 / 50'000, 0.25);
}

}  // namespace
}  // namespace mdof::drivers
