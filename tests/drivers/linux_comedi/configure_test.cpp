#include "drivers/linux_comedi/configure.h"

#include <gtest/gtest.h>

#include "drivers/registry.h"

namespace mdof::drivers {
namespace {

using linux_comedi::Reference;

std::string channel(const std::string& id, const std::string& input, const std::string& more = "") {
  return "\n[[channel]]\nid = \"" + id + "\"\ninput = \"" + input + "\"\n" + more;
}
const std::string kChannels = channel("A", "CH0") + channel("B", "CH9");

DriverContext context() {
  DriverContext made;
  made.name = "daq";
  made.rig.probes.resize(2);
  made.rig.probes[0].id = "A";
  made.rig.probes[1].id = "B";
  return made;
}

Result<linux_comedi::Settings> read(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  EXPECT_TRUE(table) << table.error().message;
  return read_linux_comedi(*table, context());
}

TEST(ComediConfigure, HasDefaults) {
  const auto settings = read(kChannels);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->device, "/dev/comedi0");
  EXPECT_EQ(settings->board, "");
  EXPECT_FALSE(settings->subdevice);
  EXPECT_FALSE(settings->convert_us);
  EXPECT_EQ(settings->rate_hz, 1000);
  ASSERT_EQ(settings->inputs.size(), 2U);
  EXPECT_EQ(settings->inputs[1].channel, (Channel{"B", Unit::volt}));
  EXPECT_EQ(settings->inputs[1].number, 9U);
  EXPECT_EQ(settings->inputs[1].low_v, -10);
  EXPECT_EQ(settings->inputs[1].high_v, 10);
  EXPECT_EQ(settings->inputs[1].reference, Reference::ground);
}

TEST(ComediConfigure, EncoderInVoltsHasNoDatum) {
  const auto settings = read(channel("A", "CH0") + channel("encoder", "CH1", "offset_mm = 2.5\n"));
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->inputs[1].channel, (Channel{"encoder", Unit::volt}));
  EXPECT_FALSE(settings->encoder.counts);
  EXPECT_EQ(settings->encoder.offset_mm, 2.5);
}

TEST(ComediConfigure, ChannelsHaveTheirOwnRangeAndReference) {
  const auto settings = read(
      "device = \"/dev/comedi2\"\nboard = \"pci-6221\"\nsubdevice = 0\nrate_hz = 500\n"
      "convert_us = 12\nrange_v = 5\nreference = \"differential\"" +
      channel("A", "CH0") + channel("B", "CH1", "range_v = [0, 10]\nreference = \"common\"\n"));
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->device, "/dev/comedi2");
  EXPECT_EQ(settings->board, "pci-6221");
  EXPECT_EQ(settings->subdevice, 0U);
  EXPECT_EQ(settings->rate_hz, 500);
  EXPECT_EQ(settings->convert_us, 12);
  EXPECT_EQ(settings->inputs[0].low_v, -5);
  EXPECT_EQ(settings->inputs[0].high_v, 5);
  EXPECT_EQ(settings->inputs[0].reference, Reference::differential);
  EXPECT_EQ(settings->inputs[1].low_v, 0);
  EXPECT_EQ(settings->inputs[1].high_v, 10);
  EXPECT_EQ(settings->inputs[1].reference, Reference::common);
}

TEST(ComediConfigure, BadValuesNameTheirKey) {
  const std::pair<std::string, const char*> wrong[] = {
      {"rate_hz = 0.2" + kChannels, "mdofd.toml:1: rate_hz: must be from 0.25"},
      {"rate_hz = 1e7" + kChannels, "rate_hz"},
      {"sampling_hz = 5" + kChannels, "sampling_hz"},
      {"range_v = 0" + kChannels, "range_v: must be greater than 0"},
      {"range_v = [10, 0]" + kChannels, "range_v: must be the two limits"},
      {"range_v = [1]" + kChannels, "range_v: must be the two limits"},
      {"reference = \"diff\"" + kChannels, "reference: must be \"ground\""},
      {"subdevice = -1" + kChannels, "subdevice: must be the number"},
      {"rate_hz = 1000\nconvert_us = 501" + kChannels, "convert_us: must be from 0.1"},
      {"convert_us = 0" + kChannels, "convert_us: must be"},
      {channel("A", "AIN0"), "give \"CH0\" for channel 0 of the subdevice"},
      {channel("A", "CH256"), "is not an input of a board"},
      {channel("A", "CH00"), "is not an input of a board"},
      {channel("encoder", "CH0", "um_per_count = 1\n"),
       "this driver does not read counters of Comedi boards"},
      {channel("A", "CH0", "um_per_count = 1\n"), "gives volts"},
      {channel("A", "CH0", "reference = 5\n"), "reference"},
  };
  for (const auto& [toml, message] : wrong) {
    const auto settings = read(toml);
    ASSERT_FALSE(settings) << toml;
    EXPECT_NE(settings.error().message.find(message), std::string::npos)
        << settings.error().message;
  }
}

TEST(ComediConfigure, IdentityIsIndependentOfTheSpelling) {
  auto table = TomlTable::parse("device = \"/dev/../dev/null\"" + kChannels, "mdofd.toml");
  const auto spec = configure_driver("linux_comedi", *table, context());
  ASSERT_TRUE(spec) << spec.error().message;
  EXPECT_EQ(spec->identity(), "/dev/null");
  EXPECT_EQ(spec->channels, (std::vector<std::string>{"A", "B"}));
  const auto driver = spec->make();
  ASSERT_TRUE(driver);
  EXPECT_EQ((*driver)->info().driver, "linux_comedi");
  const auto status = (*driver)->open();  // comedilib reports that the file is not a board
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("this is not a Comedi device"), std::string::npos)
      << status.error().message;
}

}  // namespace
}  // namespace mdof::drivers
