#include "drivers/mcc_usb1608fs_plus/configure.h"

#include <gtest/gtest.h>

namespace mdof::drivers {
namespace {

std::string channel(const std::string& id, const std::string& input, const char* more = "") {
  return "[[channel]]\nid = \"" + id + "\"\ninput = \"" + input + "\"\n" + more;
}
const std::string kChannels = channel("B", "CH3") + channel("A", "CH0");

Result<mcc_usb1608fs_plus::Settings> read(const std::string& keys, const std::string& channels) {
  auto table = TomlTable::parse(keys + channels, "mdofd.toml");
  EXPECT_TRUE(table) << table.error().message;
  DriverContext context;
  context.name = "daq";
  context.rig.probes.resize(2);
  context.rig.probes[0].id = "A";
  context.rig.probes[1].id = "B";
  return read_mcc_usb1608fs_plus(*table, context);
}

std::string refusal(const std::string& keys, const std::string& channels = kChannels) {
  const auto settings = read(keys, channels);
  return settings ? "accepted" : settings.error().message;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Usb1608Configure, ReadsItsKeys) {
  const auto settings = read("serial = \"01A2B3C4\"\nrate_hz = 100000\nrange_v = 2\n", kChannels);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->name, "daq");
  EXPECT_EQ(settings->serial, "01A2B3C4");
  EXPECT_EQ(settings->rate_hz, 100'000);
  EXPECT_EQ(settings->range.code, 3);
  EXPECT_EQ(mcc_usb1608fs_plus::mask_of(settings->inputs), 0x09);
}

TEST(Usb1608Configure, BadValuesNameTheirKey) {
  EXPECT_TRUE(has(refusal("range_v = 4\n"), "range_v"));
  EXPECT_TRUE(
      has(refusal("rate_hz = 100001\n"), "mdofd.toml:1: rate_hz: must be from 1 to 100000"));
  EXPECT_TRUE(has(refusal("rate_hz = 0\n"), "rate_hz"));
  EXPECT_TRUE(has(refusal("serial = 5\n"), "serial"));
  EXPECT_TRUE(has(refusal("rate = 5\n"), "rate_hz"));
}

TEST(Usb1608Configure, RefusesBadInputs) {
  EXPECT_TRUE(has(refusal("", channel("A", "CH8")), "CH7"));
  EXPECT_TRUE(has(refusal("", channel("A", "CH0", "um_per_count = 1\n")), "not counts"));
  EXPECT_TRUE(has(refusal("", channel("A", "CH0") + channel("B", "CH0")), "CH0"));
}

TEST(Usb1608Configure, EncoderInVoltsHasNoDatum) {
  const auto settings =
      read("", channel("A", "CH0") + channel("encoder", "CH5", "offset_mm = 3\n"));
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->inputs[1].channel, (Channel{"encoder", Unit::volt}));
  EXPECT_FALSE(settings->encoder.counts);
  EXPECT_EQ(settings->encoder.offset_mm, 3);
  EXPECT_TRUE(has(refusal("", channel("encoder", "CH0", "um_per_count = 1\n")), "um_per_V"));
}

TEST(Usb1608Settings, RequestNoStallAndImmediateSlowScans) {
  mcc_usb1608fs_plus::Settings settings;
  settings.inputs.resize(5);
  for (std::size_t i = 0; i < 5; ++i) settings.inputs[i].input = i;
  EXPECT_EQ(scan_start(mcc_usb1608fs_plus::scan_setup(settings)),
            std::string("\0\0\0\0\x3F\x9C\0\0\x1F\x80", 10));
  settings.rate_hz = 50;
  EXPECT_EQ(mcc_usb1608fs_plus::scan_setup(settings).options, 0x81);
}

TEST(Usb1608Settings, QuarterOfASecondOfTransfersIsPending) {
  for (const double samples_hz : {1000.0, 5000.0, 50'000.0, 400'000.0}) {
    const auto transfers = mcc_usb1608fs_plus::transfers_for(samples_hz);
    EXPECT_EQ(transfers.bytes % 64, 0U);
    EXPECT_GE(static_cast<double>(transfers.bytes * transfers.transfers) / 2 / samples_hz, 0.249);
  }
  // Each transfer has one packet, and there are 399 packets/s. 0.25 s would need 100 transfers,
  // but the limit is 64 transfers (1/6 s).
  EXPECT_EQ(mcc_usb1608fs_plus::transfers_for(399.0 * 32).transfers, 64U);
}

}  // namespace
}  // namespace mdof::drivers
