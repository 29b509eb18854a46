#include "drivers/channels.h"

#include <gtest/gtest.h>

#include "drivers/unwrap.h"

namespace mdof::drivers {
namespace {

Rig rig_of(std::initializer_list<const char*> ids) {
  Rig rig;
  rig.source = "rig.toml";
  for (const char* id : ids) {
    rig.probes.emplace_back();
    rig.probes.back().id = id;
  }
  return rig;
}

Result<std::vector<ChannelInput>> read(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  EXPECT_TRUE(table);
  return read_channels(*table, rig_of({"A", "left"}));
}

std::string refusal(const std::string& toml) {
  const auto channels = read(toml);
  return channels ? "accepted" : channels.error().message;
}

TEST(Channels, AreReadInTheirOrder) {
  const auto channels = read(
      "[[channel]]\nid = \"encoder\"\ninput = \"DIO0\"\num_per_count = -0.02\n"
      "[[channel]]\nid = \"A\"\ninput = \"AIN3\"\n");
  ASSERT_TRUE(channels) << channels.error().message;
  ASSERT_EQ(channels->size(), 2u);
  EXPECT_EQ((*channels)[0].id, "encoder");
  EXPECT_EQ((*channels)[0].um_per_count, -0.02);
  EXPECT_TRUE(check_um_per_count((*channels)[0]));
  EXPECT_EQ((*channels)[1].input, "AIN3");
  EXPECT_FALSE(check_um_per_count((*channels)[1]));
}

TEST(Channels, EachMistakeIsNamed) {
  const std::string a = "[[channel]]\nid = \"A\"\ninput = \"1\"\n";
  const struct {
    std::string toml, says;
  } cases[] = {
      {"", "add [[axis.device.channel]]"},
      {"[[channel]]\nid = \"lefft\"\ninput = \"1\"\n", "did you mean \"left\""},
      {"[[channel]]\nid = \"lefft\"\ninput = \"1\"\n", "mdofd.toml:2"},
      {a + a, "a second input for \"A\""},
      {a + "[[channel]]\nid = \"left\"\ninput = \"1\"\n", "is \"A\" already"},
      {"[channel]\nid = \"A\"\n", "[[channel]]"},
  };
  for (const auto& c : cases)
    EXPECT_NE(refusal(c.toml).find(c.says), std::string::npos) << refusal(c.toml);
}

TEST(Channels, AnUnknownInputNamesThoseThere) {
  ChannelInput channel;
  channel.input = "AIN77";
  channel.where = "mdofd.toml:3: channel.input";
  const std::string says = no_such_input(channel, {"AIN0", "AIN1"}).value().message;
  EXPECT_NE(says.find("mdofd.toml:3"), std::string::npos);
  EXPECT_NE(says.find("it has AIN0, AIN1"), std::string::npos);
}

TEST(Unwrap, FollowsACounterOverBothEnds) {
  Unwrap count(16);
  EXPECT_EQ(count(65'530), 65'530);
  EXPECT_EQ(count(4), 65'540);
  EXPECT_EQ(count(65'500), 65'500);
  Unwrap down(32, true);
  EXPECT_EQ(down(0xFFFFFFFF), -1);
  EXPECT_EQ(down(1), 1);
  EXPECT_EQ(down(0x7FFFFFFF), 0x7FFFFFFF);
  EXPECT_EQ(down(0x80000001), 0x80000001LL);
  down.reset();
  EXPECT_EQ(down(0x80000001), -0x7FFFFFFFLL);
}

}  // namespace
}  // namespace mdof::drivers
