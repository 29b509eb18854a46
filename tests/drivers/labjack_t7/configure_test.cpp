#include "drivers/labjack_t7/configure.h"

#include <gtest/gtest.h>

#include "drivers/registry.h"

namespace mdof::drivers {
namespace {

constexpr const char* kChannels = R"(
[[channel]]
id = "A"
input = "AIN0"
[[channel]]
id = "B"
input = "AIN13"
[[channel]]
id = "encoder"
input = "DIO0"
um_per_count = -0.05
)";

DriverContext context() {
  DriverContext c;
  c.name = "daq";
  c.rig.source = "rig.toml";
  for (const char* id : {"A", "B", "C"}) {
    Probe probe;
    probe.id = id;
    c.rig.probes.push_back(probe);
  }
  return c;
}

Result<labjack_t7::Settings> settings(const std::string& toml) {
  MDOF_TRY(TomlTable table, TomlTable::parse(toml, "mdofd.toml"));
  return read_labjack_t7(table, context());
}

// The message of the error; "accepted" if there is no error.
std::string refusal(const std::string& keys, const std::string& channels = kChannels) {
  const auto read = settings(keys + channels);
  return read ? "accepted" : read.error().message;
}

std::string with_channel(const std::string& keys) {
  return refusal("address = \"t7\"\n", "[[channel]]\n" + keys);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LabjackT7Configure, AddressAloneGivesDefaults) {
  const auto s = settings("address = \"192.168.1.207\"\n" + std::string(kChannels));
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->name, "daq");
  EXPECT_EQ(s->command.text(), "192.168.1.207:502");
  EXPECT_EQ(s->stream.text(), "192.168.1.207:702");
  EXPECT_EQ(s->rate_hz, 1000);
  EXPECT_EQ(s->range_v, 10);
  EXPECT_EQ(s->samples_per_packet, 16U);
  EXPECT_EQ(labjack_t7::scan_list(s->inputs), (std::vector<int>{0, 26, 3000, 4899}));
  ASSERT_EQ(s->inputs.size(), 3U);
  EXPECT_EQ(s->inputs[1].channel, (Channel{"B", Unit::volt}));
  EXPECT_EQ(s->inputs[2].channel, (Channel{"encoder", Unit::um}));
  EXPECT_EQ(s->inputs[2].um_per_count, -0.05);
}

TEST(LabjackT7Configure, ReadsEveryKey) {
  const auto s = settings(R"(
    address = "t7.local:1502"
    stream_port = 1702
    rate_hz = 4000
    range_v = 0.1
    resolution_index = 3
    settling_us = 25
    samples_per_packet = 40
    serial = 470012345
)" + std::string(kChannels));
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->command.text(), "t7.local:1502");
  EXPECT_EQ(s->stream.text(), "t7.local:1702");
  EXPECT_EQ(s->rate_hz, 4000);
  EXPECT_EQ(s->range_v, 0.1);
  EXPECT_EQ(s->resolution_index, 3);
  EXPECT_EQ(s->settling_us, 25);
  EXPECT_EQ(s->samples_per_packet, 40U);
  EXPECT_EQ(s->serial, 470012345U);
}

TEST(LabjackT7Configure, CounterHasASpeedLimit) {
  const auto most = [](const std::string& more) {
    const auto s = settings("address = \"t7\"\n" + std::string(kChannels) + more);
    EXPECT_TRUE(s) << s.error().message;
    return s->inputs[2].most_counts_per_s;
  };
  EXPECT_EQ(most(""), 70'000);
  EXPECT_EQ(most("most_counts_per_s = 100000\n"), 100'000);
  EXPECT_TRUE(has(refusal("address = \"t7\"\n", std::string(kChannels) + "most_counts_per_s = 0\n"),
                  "most_counts_per_s: must be more than 0"));
  EXPECT_TRUE(
      has(with_channel("id = \"A\"\ninput = \"AIN0\"\nmost_counts_per_s = 5\n"), "not counts"));
}

TEST(LabjackT7Configure, EncoderMayBeACounterOrAVoltage) {
  const auto counts = settings("address = \"t7\"\n" + std::string(kChannels));
  EXPECT_TRUE(counts->encoder.counts);
  const auto volts = settings(
      "address = \"t7\"\n[[channel]]\nid = \"A\"\ninput = \"AIN0\"\n[[channel]]\n"
      "id = \"encoder\"\ninput = \"AIN2\"\nnegative = \"AIN3\"\noffset_mm = -7\n");
  ASSERT_TRUE(volts) << volts.error().message;
  EXPECT_EQ(volts->inputs[1].channel, (Channel{"encoder", Unit::volt}));
  EXPECT_EQ(volts->inputs[1].negative, 3);
  EXPECT_FALSE(volts->encoder.counts);  // the encoder is a voltage, which has no datum
  EXPECT_EQ(volts->encoder.offset_mm, -7);
  EXPECT_TRUE(
      has(with_channel("id = \"encoder\"\ninput = \"AIN0\"\num_per_count = 5\n"), "um_per_V"));
}

TEST(LabjackT7Configure, PacketsAreShortAtEveryRate) {
  EXPECT_EQ(labjack_t7::quick_packet(4000, 7), 112U);  // 16 scans in 4 ms
  EXPECT_EQ(labjack_t7::quick_packet(10, 7), 7U);
  EXPECT_EQ(labjack_t7::quick_packet(100000, 1), 400U);
  EXPECT_LE(labjack_t7::quick_packet(1e9, 7), 512U);
}

TEST(LabjackT7Configure, RefusesBadKeysWithTheirPlace) {
  const std::string a = "address = \"t7\"\n";
  EXPECT_TRUE(has(refusal(""), "address"));
  EXPECT_TRUE(has(refusal("address = \"t7:x\"\n"), "mdofd.toml:1: address"));
  EXPECT_TRUE(has(refusal(a + "stream_port = 0\n"), "mdofd.toml:2: stream_port"));
  EXPECT_TRUE(has(refusal(a + "rate_hz = 25001\n"), "from 1 to 25000"));
  EXPECT_TRUE(has(refusal(a + "rate_hz = nan\n"), "rate_hz"));
  EXPECT_TRUE(has(refusal(a + "rate_hz = 0\n"), "rate_hz"));
  EXPECT_TRUE(has(refusal(a + "range_v = 5\n"), "10, 1, 0.1 or 0.01"));
  EXPECT_TRUE(has(refusal(a + "resolution_index = 9\n"), "resolution_index"));
  EXPECT_TRUE(has(refusal(a + "settling_us = -1\n"), "settling_us"));
  EXPECT_TRUE(has(refusal(a + "samples_per_packet = 10\n"), "multiple of 4"));
  EXPECT_TRUE(has(refusal(a + "samples_per_packet = 516\n"), "512"));
  EXPECT_TRUE(has(refusal(a + "serial = -3\n"), "serial"));
  // The message names the nearest known key.
  EXPECT_TRUE(has(refusal(a + "rate = 5\n"), "rate_hz"));
}

TEST(LabjackT7Configure, RefusesBadChannels) {
  EXPECT_TRUE(has(with_channel("id = \"A\"\ninput = \"AIN14\"\n"), "AIN13, DIO0"));
  EXPECT_TRUE(has(with_channel("id = \"D\"\ninput = \"AIN0\"\n"), "neither a probe"));
  EXPECT_TRUE(has(with_channel("id = \"encoder\"\ninput = \"DIO0\"\n"), "um_per_count"));
  EXPECT_TRUE(has(with_channel("id = \"A\"\ninput = \"AIN0\"\num_per_count = 1\n"), "um_per_V"));
  EXPECT_TRUE(has(refusal("address = \"t7\"\n", ""), "channel"));
}

TEST(LabjackT7Configure, InputsMayBeDifferentialWithOwnRange) {
  const std::string a = "address = \"t7\"\n";
  const auto pair = [](const std::string& input, const std::string& negative) {
    return "[[channel]]\nid = \"C\"\ninput = \"" + input + "\"\nnegative = \"" + negative + "\"\n";
  };
  const auto s = settings(a + kChannels + pair("AIN2", "AIN3") + "range_v = 1\n");
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->inputs[3].ain, 2);
  EXPECT_EQ(s->inputs[3].negative, 3);
  EXPECT_EQ(s->inputs[3].range_v, 1);
  EXPECT_EQ(s->inputs[0].negative, -1);
  EXPECT_EQ(s->inputs[0].range_v, 0);
  EXPECT_TRUE(has(refusal(a, kChannels + pair("AIN2", "AIN5")), "negative = \"AIN3\" with AIN2"));
  EXPECT_TRUE(
      has(refusal(a, kChannels + pair("AIN3", "AIN2")), "give negative = \"AIN3\" with AIN2"));
  EXPECT_TRUE(
      has(refusal(a, kChannels + pair("AIN5", "AIN6")), "give negative = \"AIN5\" with AIN4"));
  EXPECT_TRUE(has(refusal(a, "[[channel]]\nid = \"A\"\ninput = \"AIN3\"\n" + pair("AIN2", "AIN3")),
                  "AIN3 is the negative input of \"C\""));
  EXPECT_TRUE(has(refusal(a, kChannels + pair("AIN2", "GND")), "negative = \"AIN3\" with AIN2"));
  EXPECT_TRUE(
      has(refusal(a, kChannels + pair("AIN12", "AIN13")), "AIN13 is the negative input of \"C\""));
  EXPECT_TRUE(has(refusal(a, kChannels + pair("AIN2", "AIN3") + "range_v = 2\n"),
                  "range_v: must be 10, 1, 0.1 or 0.01"));
  EXPECT_TRUE(has(refusal(a, std::string(kChannels) + "range_v = 1\n"), "apply to an AIN"));
}

TEST(LabjackT7Configure, EncoderMayUseOtherLinePairs) {
  const auto encoder = [](const std::string& id, const std::string& input) {
    return "[[channel]]\nid = \"" + id + "\"\ninput = \"" + input + "\"\num_per_count = 0.05\n";
  };
  const std::string a = "address = \"t7\"\n";
  for (const int line : {0, 2, 6}) {
    const auto s = settings(a + encoder("encoder", "DIO" + std::to_string(line)));
    ASSERT_TRUE(s) << s.error().message;
    EXPECT_EQ(s->inputs[0].dio, line);
    EXPECT_EQ(labjack_t7::scan_list(s->inputs), (std::vector<int>{3000 + 2 * line, 4899}));
  }
  EXPECT_TRUE(has(refusal(a, encoder("encoder", "DIO4")), "AIN13, DIO0, DIO2, DIO6"));
  EXPECT_TRUE(has(refusal(a, kChannels + encoder("C", "DIO2")), "the first is DIO0"));
}

TEST(LabjackT7Configure, RegistryMakesTheDriver) {
  auto table = TomlTable::parse("address = \"t7\"\n" + std::string(kChannels), "mdofd.toml");
  ASSERT_TRUE(table);
  const auto spec = configure_driver("labjack_t7", *table, context());
  ASSERT_TRUE(spec) << spec.error().message;
  EXPECT_TRUE(spec->live);
  EXPECT_TRUE(spec->recorded);
  EXPECT_FALSE(spec->simulated);
  const auto driver = spec->make();
  ASSERT_TRUE(driver);
  const DeviceInfo info = (*driver)->info();
  EXPECT_EQ(info.name, "daq");
  EXPECT_EQ(info.driver, "labjack_t7");
  EXPECT_EQ(info.rate_hz, 1000);
  ASSERT_EQ(info.channels.size(), 3U);
  SampleBlock block;
  EXPECT_FALSE((*driver)->read(block, std::chrono::milliseconds(0)));  // the device is not open
}

}  // namespace
}  // namespace mdof::drivers
