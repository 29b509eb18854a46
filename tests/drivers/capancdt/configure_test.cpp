#include "drivers/capancdt/configure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/registry.h"

namespace mdof::drivers {
namespace {

DriverContext context() {
  DriverContext context;
  context.name = "probes";
  context.rig.source = "rig.toml";
  for (const char* id : {"A", "B", "C"}) {
    Probe probe;
    probe.id = id;
    probe.calibration.reads_stated = true;
    context.rig.probes.push_back(probe);
  }
  return context;
}

const std::string kChannel = "[[channel]]\nid = \"A\"\ninput = \"1\"\n";

Result<DriverSpec> configure(const std::string& text, double settle_s = 0.1) {
  auto table = TomlTable::parse(text, "mdofd.toml");
  if (!table) return tl::unexpected(table.error());
  DriverContext with = context();
  with.settle_s = settle_s;
  return configure_driver("capancdt", *table, with);
}
void expect_error(const std::string& text, const std::string& message) {
  const auto spec = configure(text);
  ASSERT_FALSE(spec) << message;
  EXPECT_EQ(spec.error().code, ErrorCode::bad_input);
  EXPECT_NE(spec.error().message.find(message), std::string::npos) << spec.error().message;
}

TEST(CapancdtConfigure, ReadsTheRequiredKeys) {
  const auto spec = configure("address = \"10.0.0.7\"\n" + kChannel);
  ASSERT_TRUE(spec) << spec.error().message;
  EXPECT_EQ(spec->driver, "capancdt");
  EXPECT_EQ(spec->name, "probes");
  EXPECT_TRUE(spec->live);
  EXPECT_TRUE(spec->recorded);
  EXPECT_FALSE(spec->simulated);
  const auto driver = spec->make();
  ASSERT_TRUE(driver);
  const DeviceInfo info = (*driver)->info();
  EXPECT_EQ(info.description, "capaNCDT at 10.0.0.7:23");
  EXPECT_EQ(info.channels, (std::vector<Channel>{{"A", Unit::um}}));
}

// By default a reading is a displacement, and a gap would then change the sign of all errors.
TEST(CapancdtConfigure, RefusesAProbeOfUnknownSense) {
  auto table = TomlTable::parse("address = \"box\"\n" + kChannel, "mdofd.toml");
  ASSERT_TRUE(table);
  DriverContext with = context();
  with.rig.probes[1].calibration.reads_stated = false;  // not connected
  EXPECT_TRUE(configure_driver("capancdt", *table, with));
  with.rig.probes[0].calibration.reads_stated = false;
  auto again = TomlTable::parse("address = \"box\"\n" + kChannel, "mdofd.toml");
  const auto spec = configure_driver("capancdt", *again, with);
  ASSERT_FALSE(spec);
  EXPECT_EQ(spec.error().code, ErrorCode::bad_input);
  for (const char* part : {"mdofd.toml:", "rig.toml", "\"A\"", "reads = \"gap\""})
    EXPECT_NE(spec.error().message.find(part), std::string::npos) << spec.error().message;
}

TEST(CapancdtConfigure, RefusesAveragingLongerThanSettling) {
  const std::string text =
      "address = \"box\"\nsample_time_us = 32768\naveraging = \"moving\"\naveraged_values = 4\n" +
      kChannel;
  expect_error(text,
               "mdofd.toml:4: averaged_values: the averaging takes 0.1311 s, which is longer than");
  EXPECT_TRUE(configure(text, 0.2));
  EXPECT_TRUE(configure(text, 0));
}

TEST(CapancdtConfigure, ReadsEveryKey) {
  const auto spec = configure(
      "address = \"box:24\"\ndata_port = 10002\nserial = \"1001\"\nconfigure = false\n"
      "sample_time_us = 960\naveraging = \"arithmetic\"\naveraged_values = 4\nguard_counts = 0\n" +
      kChannel + "range_um = 2000\n[[channel]]\nid = \"C\"\ninput = \"32\"\n");
  ASSERT_TRUE(spec) << spec.error().message;
  const auto driver = spec->make();
  ASSERT_TRUE(driver);
  EXPECT_EQ((*driver)->info().channels.size(), 2u);
  EXPECT_EQ((*driver)->info().description, "capaNCDT at box:24");
}

TEST(CapancdtConfigure, RefusesBadAddresses) {
  expect_error(kChannel, "mdofd.toml:1: address: is missing");
  expect_error("address = \"\"\n" + kChannel,
               "mdofd.toml:1: address: must be the address of the controller");
  expect_error("address = \"box:x\"\n" + kChannel,
               "mdofd.toml:1: address: \"box:x\" is not an address");
}

TEST(CapancdtConfigure, RefusesBadSettings) {
  const std::string begin = "address = \"box\"\n";
  const struct {
    const char *key, *message;
  } cases[] = {
      {"data_port = 0", "mdofd.toml:2: data_port: must be from 1 to 65535"},
      {"sample_time_us = 0", "mdofd.toml:2: sample_time_us: must be from 1 to 10000000"},
      {"sample_time_us = 1.5", "mdofd.toml:2: sample_time_us: must be a whole number"},
      {"averaging = \"medan\"",
       "mdofd.toml:2: averaging: must be \"none\", \"moving\", "
       "\"arithmetic\", \"median\" or \"dynamic\"; did you mean "
       "\"median\"?"},
      {"averaged_values = 9", "mdofd.toml:2: averaged_values: must be from 2 to 8"},
      {"guard_counts = -1", "mdofd.toml:2: guard_counts: must be from 0 to"},
      {"configure = 1", "mdofd.toml:2: configure: must be true or false"},
      {"sampletime_us = 1",
       "mdofd.toml:2: sampletime_us: unknown key; did you mean "
       "\"sample_time_us\"?"},
  };
  for (const auto& c : cases) expect_error(begin + c.key + "\n" + kChannel, c.message);
}

TEST(CapancdtConfigure, RefusesBadChannels) {
  const std::string begin = "address = \"box\"\n";
  expect_error(begin, "channel: is missing");
  for (const char* input : {"0", "33", "AIN0", "", "1 ", "-1", "01"})
    expect_error(begin + "[[channel]]\nid = \"A\"\ninput = \"" + input + "\"\n",
                 std::string("input \"") + input + "\" is not a channel of a controller");
  expect_error(begin + "[[channel]]\nid = \"D\"\ninput = \"1\"\n",
               "\"D\" is neither a probe of rig.toml");
  expect_error(begin + kChannel + "range_um = 0\n",
               "mdofd.toml:5: channel[1].range_um: must be greater than 0");
  expect_error(begin + kChannel + "um_per_count = 1\n", "um_per_count: applies to encoders");
  expect_error(begin + kChannel + "rangeum = 1\n",
               "mdofd.toml:5: channel[1].rangeum: unknown key; did you mean \"range_um\"?");
  expect_error(begin + kChannel + "[[channel]]\nid = \"B\"\ninput = \"1\"\n",
               "input \"1\" is already used by \"A\"");
}

}  // namespace
}  // namespace mdof::drivers
